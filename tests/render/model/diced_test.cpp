#include "render/model/diced.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "render/model/plant_model.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "tests/support/small_vine.h"

namespace espalier::render {
namespace {

const sim::Frame& kFrame = tests::kVineFrame;

/// Each voxel has a colour of its own, by which its fragments can be told.
sim::Colour colourOf(sim::Voxel v) {
  return sim::Colour(v) / 32.0f;
}

double areaOf(sim::Vec3 a, sim::Vec3 b, sim::Vec3 c) {
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

template <class Mesh, class Positions>
double areaOf(const Mesh& mesh, const Positions& positions) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) sum += areaOf(positions[t[0]], positions[t[1]], positions[t[2]]);
  return sum;
}

TEST(Diced, TrianglesLieInTheVoxelsWhoseColoursTheyHave) {
  const sim::Mesh wall = tests::wallMesh();
  const DicedMesh mesh = diced(uncut(wall, kFrame), kFrame, colourOf);
  EXPECT_EQ(mesh.name, "wall");
  ASSERT_GT(mesh.triangles.size(), 3000u);
  EXPECT_EQ(mesh.positions_m.size(), mesh.colours.size());
  std::size_t beyond = 0;  // the floor's sides and its bottom lie below the world
  for (const auto& t : mesh.triangles) {
    const auto& p = mesh.positions_m;
    if (p[t[0]].y + p[t[1]].y + p[t[2]].y < 0.0f) {
      ++beyond;
      continue;
    }
    const sim::Colour colour = mesh.colours[t[0]];
    const sim::Vec3 voxel(32.0f * colour);
    for (const std::uint32_t corner : t) {
      ASSERT_EQ(mesh.colours[corner], colour);
      const sim::Vec3 from = sim::voxelFromWorld(kFrame, sim::Vec3(mesh.positions_m[corner])) - voxel;
      ASSERT_LE(std::max({std::abs(from.x), std::abs(from.y), std::abs(from.z)}), 0.5 + 1e-5);
    }
  }
  EXPECT_GE(beyond, 10u);
  EXPECT_LE(beyond, 12u * 2u);
  EXPECT_NEAR(areaOf(mesh, mesh.positions_m) / areaOf(wall, wall.vertices_m), 1.0, 1e-6);
  EXPECT_EQ(mesh.fragments, fragmentsOf(uncut(wall, kFrame), kFrame.size));
}

TEST(Diced, OneVertexStandsForAllInOnePlaceWithOneColour) {
  const auto each = diced(uncut(tests::wallMesh(), kFrame), kFrame, colourOf);
  const auto grey =
      diced(uncut(tests::wallMesh(), kFrame), kFrame, [](sim::Voxel) { return sim::Colour(0.5f); });
  for (const DicedMesh* mesh : {&each, &grey}) {
    std::set<std::array<float, 6>> known;
    for (std::size_t i = 0; i < mesh->positions_m.size(); ++i) {
      const auto &p = mesh->positions_m[i], &c = mesh->colours[i];
      EXPECT_TRUE(known.insert({p.x, p.y, p.z, c.r, c.g, c.b}).second) << i;
    }
  }
  EXPECT_EQ(each.triangles.size(), grey.triangles.size());
  EXPECT_LT(2 * grey.positions_m.size(), each.positions_m.size());
}

/// Of a closed surface every edge lies between two triangles, as before, but for where the vine stands on the
/// world's lower side: what lies beyond is in one piece there. In one colour vertices tell places.
TEST(Diced, AClosedSurfaceStaysClosed) {
  const PlantModel plant = modelPlant(tests::smallVine(), kFrame);
  const auto mesh = diced(uncut(plant.stems, kFrame), kFrame, [](sim::Voxel) { return sim::Colour(0.5f); });
  EXPECT_EQ(mesh.name, "vine stems");
  ASSERT_GT(mesh.triangles.size(), plant.stems.triangles.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  std::size_t open = 0;
  const auto at_side = [&](std::uint32_t v) { return std::abs(mesh.positions_m[v].y) < 1e-6f; };
  for (const auto& [edge, sides] : edges)
    open += sides != 0 && !(at_side(edge.first) && at_side(edge.second));
  EXPECT_EQ(open, 0u) << "of " << edges.size();
  EXPECT_NEAR(areaOf(mesh, mesh.positions_m) / areaOf(plant.stems, plant.stems.positions_m), 1.0, 1e-5);
}

TEST(Diced, WhatIsAllButInAPlaneIsCutToNoSlivers) {
  sim::Mesh mesh;
  mesh.name = "sheet";
  const double y = kFrame.origin_m.y + 2.5 * kFrame.voxel_m, off = 1e-7 * kFrame.voxel_m;
  mesh.vertices_m = {{0, y + off, 0}, {0, y - off, 0.4}, {0.4, y + off, 0}};
  mesh.triangles = {{0, 1, 2}};
  const auto cut = diced(uncut(mesh, kFrame), kFrame, colourOf);
  for (const sim::Colour colour : cut.colours) EXPECT_EQ(colour.g, colourOf({0, 3, 0}).g);
  EXPECT_LT(cut.fragments, 80u);
  mesh.triangles = {{0, 1, 3}};
  EXPECT_THROW(uncut(mesh, kFrame), sim::InputError);
  EXPECT_TRUE(diced(Uncut(), kFrame, colourOf).empty());
}

TEST(Diced, IsTheSameOnAnyNumberOfThreads) {
  const PlantModel plant = modelPlant(tests::smallVine(), kFrame);
  std::vector<DicedMesh> meshes;
  for (const int threads : {1, 2, 5}) {
    const sim::Shaken shaken;
    sim::onThreads(threads, [&] { meshes.push_back(diced(uncut(plant.stems, kFrame), kFrame, colourOf)); });
  }
  for (const DicedMesh& mesh : meshes) {
    EXPECT_TRUE(mesh.positions_m == meshes[0].positions_m && mesh.colours == meshes[0].colours &&
                mesh.triangles == meshes[0].triangles);
  }
}

}  // namespace
}  // namespace espalier::render
