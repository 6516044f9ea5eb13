#include "sim/cut/pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "sim/base/error.h"
#include "sim/base/hasher.h"
#include "sim/base/parallel.h"
#include "sim/cut/sheets.h"
#include "tests/support/messages.h"

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
  const std::vector<Vec3> way = {
      {-1.2, 0.7, 1.5}, {-0.5, 1.0, 1.5}, {0.1, 0.8, 1.5}, {0.4, 1.2, 1.5}, {1.2, 1.1, 1.5}};
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
    const double out =
        0.2 * (glm::length(Vec3(0.7, 0.3, 0.0)) / 0.7 + glm::length(Vec3(0.8, 0.1, 0.0)) / 0.8);
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

TEST(CutSolid, RoughCutsAreClosedWhateverTheirSeed) {
  const Mesh block = box({-1, 0, -1}, {1, 2, 1});
  CutSettings settings = across(0.1);
  settings.least_share = 0.0;
  for (const std::uint64_t stream : {1u, 2u, 3u}) {
    settings.stream = stream;
    settings.rough = CutRoughness{0.08, 0.25};  // so rough that crumbs fall out
    const Pieces cut = cutSolid(block, zigzag(), settings);
    EXPECT_GE(cut.pieces.size(), 2u);
    for (const Piece& piece : cut.pieces) {
      EXPECT_EQ(wrongEdges(piece.mesh), 0u);
      EXPECT_GT(piece.volume_m3, 0.0);
    }
    EXPECT_LT(sumOf(cut), cut.solid_m3);
    EXPECT_GT(sumOf(cut), 0.85 * cut.solid_m3);
  }
}

TEST(CutSolid, WithoutASweepItBoresATunnel) {
  const Mesh block = box({-1, 0, -1}, {1, 2, 1});
  const std::vector<CutLine> line = {{{-3, 1, 0.1}, {3, 1, 0.1}}};
  CutSettings settings = across(0.4);
  settings.voxel_m = 0.04;
  settings.sweep_m = Vec3(0.0);
  const Pieces cut = cutSolid(block, line, settings);
  ASSERT_EQ(cut.pieces.size(), 1u);
  EXPECT_NEAR(cut.solid_m3 - cut.pieces[0].volume_m3, 2.0 * M_PI * 0.04, 0.01);
  EXPECT_EQ(wrongEdges(cut.pieces[0].mesh), 0u);
}

/// A block with a cavity of one cubic metre, its walls wound as they should be or all the other way.
Mesh hollow(bool inside_out) {
  Mesh mesh = box({-1, 0, -1}, {1, 2, 1});
  const Mesh cavity = box({-0.5, 0.5, -0.5}, {0.5, 1.5, 0.5});
  mesh.vertices_m.insert(mesh.vertices_m.end(), cavity.vertices_m.begin(), cavity.vertices_m.end());
  for (const auto& [a, b, c] : cavity.triangles) mesh.triangles.push_back({8 + a, 8 + c, 8 + b});
  mesh.region.assign(24, 0);
  mesh.material.assign(24, 0);
  if (inside_out)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TEST(CutSolid, CavitiesStayInTheirPieces) {
  const std::vector<CutLine> corner = {{{-3, 1.8, 2}, {3, 1.8, 2}}};
  for (const bool inside_out : {false, true}) {
    const Pieces cut = cutSolid(hollow(inside_out), corner, across(0.06));
    ASSERT_EQ(cut.pieces.size(), 2u);
    EXPECT_NEAR(cut.solid_m3, 7.0, 0.02);
    EXPECT_NEAR(cut.pieces[0].volume_m3, 4.0 * 1.77 - 1.0, 0.015);
    EXPECT_EQ(wrongEdges(cut.pieces[0].mesh), 0u);
  }
}

TEST(CutSolid, FacesKeepWhatTheyWereAndThoseLaidBareAreNew) {
  Mesh block = box({-1, 0, -1}, {1, 2, 1});
  block.materials.resize(2);
  block.materials[0].name = "stone";
  block.materials[1].name = "moss";
  block.material[6] = block.material[7] = 1;  // above
  for (const Vec3& p : block.vertices_m) block.uvs.emplace_back(p.x, p.z);
  CutSettings settings = across(0.06);
  settings.inside = Colour(1, 0, 0);
  const std::vector<CutLine> line = {{{-3, 0.75, 2}, {3, 0.75, 2}}};
  const Pieces cut = cutSolid(block, line, settings);
  std::size_t bare = 0, moss = 0;
  for (const Piece& piece : cut.pieces) {
    const Mesh& mesh = piece.mesh;
    ASSERT_EQ(mesh.materials.size(), 3u);
    EXPECT_EQ(mesh.materials[2].colour, Colour(1, 0, 0));
    ASSERT_EQ(mesh.uvs.size(), mesh.vertices_m.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Vec3 middle(0.0);
      for (const std::uint32_t v : mesh.triangles[t]) middle += mesh.vertices_m[v] / 3.0;
      if (std::max(std::abs(middle.x), std::abs(middle.z)) > 0.95) continue;  // rims are round
      const bool laid_bare = std::abs(middle.y - 0.75) < 0.1;
      bare += laid_bare;
      EXPECT_EQ(mesh.material[t], laid_bare ? 2u : middle.y > 1.9 ? 1u : 0u);
      if (middle.y < 1.9) continue;
      ++moss;
      for (const std::uint32_t v : mesh.triangles[t]) {
        EXPECT_NEAR(mesh.uvs[v].x, mesh.vertices_m[v].x, 1e-5);
        EXPECT_NEAR(mesh.uvs[v].y, mesh.vertices_m[v].z, 1e-5);
      }
    }
  }
  EXPECT_GT(bare, 1000u);
  EXPECT_GT(moss, 1000u);
}

TEST(CutSolid, TellsWhatCannotBeCut) {
  const Mesh block = box({-1, 0, -1}, {1, 2, 1});
  const std::vector<CutLine> line = {{{-3, 0.75, 2}, {3, 0.75, 2}}};
  Mesh open = block;
  open.triangles.pop_back();
  open.material.pop_back();
  open.region.pop_back();
  const auto why = [&](const Mesh& mesh, const CutSettings& settings) {
    return tests::messageOf([&] { cutSolid(mesh, line, settings); });
  };
  EXPECT_EQ(
      why(open, across(0.06)),
      "mesh 'block': is not closed: 3 edges of it have no neighbour, the first at [1, 1, 0] m; expected a "
      "solid without holes");
  CutSettings fine = across(0.06);
  fine.voxel_m = 0.04;
  EXPECT_EQ(
      why(block, fine),
      "mesh 'block': a kerf of 0.06 m is less than 2 voxels of 0.04 m, which show it; expected a kerf of at "
      "least 0.08 m, or a voxel of at most 0.03 m");
  EXPECT_NE(why(block, across(0.0015)).find("expected a voxel of at least"), std::string::npos);
  EXPECT_NE(why(block, across(1e-5)).find("expected at most 15000"), std::string::npos);
  CutSettings wide = across(6.0);
  wide.voxel_m = 0.1;
  EXPECT_NE(why(block, wide).find("nothing is left of it"), std::string::npos);
  EXPECT_NE(why(block, across(40.0)).find("holds nothing that voxels of 13.3 m show"), std::string::npos);
  Mesh none = block;
  none.triangles.clear();
  EXPECT_NE(why(none, across(0.06)).find("has no inside"), std::string::npos);
}

TEST(Sheets, AreAsFarAwayAsTheirNearestPlace) {
  const std::vector<Sheet> sheets = {{{1, 2, 3}, {4, 0, 1}, {1, 3, -2}},
                                     {{0, 0, 0}, {5, 0, 0}, {0, 0, 0}},
                                     {{0, 1, 0}, {3, 1, 0}, {-6, -2, 0}},
                                     {{2, 2, 2}, {0, 0, 0}, {0, 0, 0}}};
  for (const Sheet& sheet : sheets) {
    for (const Vec3 p : {Vec3(0, 0, 0), Vec3(3, 4, 1), Vec3(9, -2, 5), Vec3(2.5, 2, 3.5)}) {
      double nearest = INFINITY;
      for (int i = 0; i <= 400; ++i)
        for (int k = 0; k <= 400; ++k)
          nearest = std::min(nearest,
                             glm::distance(p, sheet.at + i / 400.0 * sheet.along + k / 400.0 * sheet.across));
      EXPECT_NEAR(distanceTo(sheet, p), nearest, 0.02);
      EXPECT_LE(distanceTo(sheet, p), nearest + 1e-12);
    }
  }
}

}  // namespace
}  // namespace espalier::sim
