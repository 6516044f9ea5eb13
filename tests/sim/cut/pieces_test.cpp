#include "sim/cut/pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "sim/base/error.h"
#include "sim/base/hasher.h"
#include "sim/base/parallel.h"

namespace espalier::sim {
namespace {

/// A box of twelve triangles, each corner once.
Mesh box(Vec3 low, Vec3 high) {
  Mesh mesh;
  mesh.name = "block";
  for (int k = 0; k < 8; ++k)
    mesh.vertices_m.emplace_back(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  mesh.region.assign(12, 0);
  mesh.material.assign(12, 0);
  mesh.regions = {"stone"};
  mesh.materials.resize(1);
  return mesh;
}

/// Edges that have not two triangles wound against each other.
std::size_t wrongEdges(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
  std::size_t wrong = 0;
  for (const auto& [side, count] : sides) {
    const auto back = sides.find({side.second, side.first});
    wrong += count != 1 || back == sides.end() || back->second != 1;
  }
  return wrong;
}

double sumOf(const Pieces& cut) {
  double sum = 0.0;
  for (const Piece& piece : cut.pieces) sum += piece.volume_m3;
  return sum;
}

CutSettings across(double kerf_m) {
  CutSettings settings;
  settings.kerf_m = kerf_m;
  settings.voxel_m = kerf_m / 3.0;
  settings.sweep_m = {0.0, 0.0, -4.0};
  return settings;
}

/// A crooked way across the front of the block.
std::vector<CutLine> zigzag() {
  const std::vector<Vec3> way = {{-1.2, 0.7, 1.5}, {-0.5, 1.0, 1.5}, {0.1, 0.8, 1.5}, {0.4, 1.2, 1.5}, {1.2, 1.1, 1.5}};
  std::vector<CutLine> lines;
  for (std::size_t i = 1; i < way.size(); ++i) lines.push_back({way[i - 1], way[i]});
  return lines;
}

TEST(CutSolid, ASheetHalvesABlockAndTakesItsKerf) {
  const Mesh block = box({-1, 0, -1}, {1, 2, 1});
  const std::vector<CutLine> line = {{{-3, 0.75, 2}, {3, 0.75, 2}}};
  const Pieces cut = cutSolid(block, line, across(0.06));
  ASSERT_EQ(cut.pieces.size(), 2u);
  EXPECT_NEAR(cut.solid_m3, 8.0, 0.01);
  EXPECT_NEAR(cut.pieces[0].volume_m3, 4.0 * (1.25 - 0.03), 0.008);
  EXPECT_NEAR(cut.pieces[1].volume_m3, 4.0 * (0.75 - 0.03), 0.008);
  EXPECT_NEAR(cut.pieces[0].middle_m.y, 0.5 * (0.78 + 2.0), 2e-3);
  EXPECT_EQ(cut.crumbs, 0u);
  for (const Piece& piece : cut.pieces) EXPECT_EQ(wrongEdges(piece.mesh), 0u);
}

TEST(CutSolid, WhatIsThereIsPiecesCrumbsAndKerf) {
  const Mesh block = box({-1, 0, -1}, {1, 2, 1});
  for (const double scale : {1.0, 0.7}) {
    CutSettings settings = across(0.06);
    settings.voxel_m *= scale;
    const Pieces cut = cutSolid(block, zigzag(), settings);
    ASSERT_EQ(cut.pieces.size(), 2u);
    double length = 0.0;  // within the block
    for (const CutLine& line : zigzag()) length += glm::length(line.to_m - line.from_m);
    const double out = 0.2 * (glm::length(Vec3(0.7, 0.3, 0.0)) / 0.7 + glm::length(Vec3(0.8, 0.1, 0.0)) / 0.8);
    EXPECT_NEAR(sumOf(cut), cut.solid_m3 - 2.0 * 0.06 * (length - out), 0.012);
  }
}

TEST(CutSolid, TheSameBytesOnAnyNumberOfThreads) {
  const Mesh block = box({-1, 0, -1}, {1, 2, 1});
  CutSettings settings = across(0.12);
  settings.rough = CutRoughness{0.03, 0.4};
  settings.stream = 7;
  std::set<std::uint64_t> hashes;
  for (const int threads : {1, 2, 5}) {
    onThreads(threads, [&] {
      const Pieces cut = cutSolid(block, zigzag(), settings);
      Hasher hash;
      for (const Piece& piece : cut.pieces) {
        hash.add(piece.mesh.vertices_m);
        hash.add(contentHash(piece.mesh));
      }
      hashes.insert(hash.digest());
    });
  }
  EXPECT_EQ(hashes.size(), 1u);
  settings.stream = 8;
  Hasher other;
  for (const Piece& piece : cutSolid(block, zigzag(), settings).pieces) {
    other.add(piece.mesh.vertices_m);
    other.add(contentHash(piece.mesh));
  }
  EXPECT_FALSE(hashes.contains(other.digest()));
}

}  // namespace
}  // namespace espalier::sim
