#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "rules/growth/make_process.h"
#include "rules/growth/voxel_widths.h"
#include "scenes/read/read_rules.h"
#include "sim/grow/grow.h"
#include "sim/tile/build_world.h"
#include "tests/support/lively.h"
#include "tests/support/scratch.h"
#include "tests/support/small_vine.h"

/// The library's ivy is one plant in voxels of any size.
namespace espalier {
namespace {

using sim::Vec3;

constexpr double kWidth = 1.2, kHeight = 0.9, kFront = 0.12;  // of the wall, metres; it faces +z
constexpr double kCell = 0.03;                                // of which its cover is counted

/// A wall on a floor. Faces lie a millimetre behind the voxels' own, so that for each size of voxel the first
/// free one begins there.
sim::World wall(double voxel_m, int layers) {
  constexpr double kBehind = 0.001;
  sim::Mesh mesh;
  mesh.name = "yard";
  mesh.regions = {"all"};
  tests::addBox(mesh, {0.0, -0.06, 0.0}, {kWidth, -kBehind, 0.6 - kBehind}, {"soil", sim::Colour(0.2f)});
  tests::addBox(mesh, {0.0, -0.06, 0.0}, {kWidth, kHeight, kFront - kBehind}, {"brick", sim::Colour(0.3f)});
  const sim::Voxel size(glm::round(Vec3(kWidth, kHeight + 0.18, 0.6) / voxel_m));
  return sim::buildWorld({Vec3(0.5 * voxel_m, 0.5 * voxel_m - 0.06, 0.5 * voxel_m), voxel_m, size},
                         {{mesh, true}}, layers);
}

struct Cover {
  double area_m2 = 0.0;  ///< of the wall's cells of 3 cm that are behind a leaf, seen from the front
  double leaf_m = 0.0;   ///< mean length of a leaf
  double leaves = 0.0;
};

using Cells = std::set<std::pair<int, int>>;

/// Marks the cells in which a triangle's points lie, one every 5 mm.
void mark(Vec3 a, Vec3 b, Vec3 c, Cells& cells) {
  constexpr double kStep = 0.005;
  const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  const int steps = static_cast<int>(std::ceil(longest / kStep)) + 1;
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; i + k <= steps; ++k) {
      const Vec3 p = a + (b - a) * (double(i) / steps) + (c - a) * (double(k) / steps);
      if (p.x > 0.0 && p.x < kWidth && p.y > 0.0 && p.y < kHeight)
        cells.insert({static_cast<int>(p.x / kCell), static_cast<int>(p.y / kCell)});
    }
  }
}

Cover coverOf(const std::vector<sim::Plant>& plants, const sim::Frame& frame) {
  Cover cover;
  Cells cells;
  for (const sim::Plant& plant : plants) {
    for (const sim::PlacedElement& leaf : plant.elements) {
      ++cover.leaves;
      cover.leaf_m += leaf.scale * frame.voxel_m;
      for (const auto& polygon : plant.shapes[static_cast<std::size_t>(leaf.shape)].polygons) {
        const auto at = [&](std::size_t i) {
          return sim::worldFromVoxel(frame, sim::placed(leaf, polygon[i]));
        };
        for (std::size_t i = 2; i < polygon.size(); ++i) mark(at(0), at(i - 1), at(i), cells);
      }
    }
  }
  cover.area_m2 = static_cast<double>(cells.size()) * kCell * kCell;
  cover.leaf_m /= std::max(1.0, cover.leaves);
  return cover;
}

/// Two plants at the wall's foot, on average over some runs.
Cover grown(const std::shared_ptr<const rules::RuleSet>& ivy, double voxel_m) {
  constexpr int kRuns = 6;
  Cover mean;
  for (int run = 0; run < kRuns; ++run) {
    sim::World world = wall(voxel_m, rules::layersNeeded(*ivy, voxel_m, rules::kNoLimit).layers);
    std::vector<sim::Seed> seeds;
    for (const double x : {0.345, 0.855}) {
      seeds.push_back({sim::voxelFromWorld(world.frame(), {x, 0.005, kFront + 0.005}),
                       sim::keyOfName(std::to_string(x))});
    }
    auto settings = tests::brightSettings(13);
    settings.seed = static_cast<std::uint64_t>(run);
    const auto growth = sim::grow(world, {{"ivy", rules::makeProcess(ivy, voxel_m), seeds}}, settings);
    const Cover cover = coverOf(growth.plants, world.frame());
    mean.area_m2 += cover.area_m2 / kRuns;
    mean.leaf_m += cover.leaf_m / kRuns;
    mean.leaves += cover.leaves / kRuns;
  }
  return mean;
}

TEST(Ivy, IsOnePlantInVoxelsOf1And2And3Centimetres) {
  const auto ivy = scenes::readRules(tests::sourceFolder() / "rules/library/ivy.yaml");
  ASSERT_TRUE(ivy) << scenes::format(ivy.problems());
  std::vector<double> areas, lengths;
  for (const double voxel_m : {0.01, 0.02, 0.03}) {
    const Cover cover = grown(*ivy, voxel_m);
    EXPECT_GT(cover.leaves, 50.0) << voxel_m;
    SCOPED_TRACE(fmt::format("{} m: {:.3f} m2 covered, {:.0f} leaves of {:.4f} m", voxel_m, cover.area_m2,
                             cover.leaves, cover.leaf_m));
    areas.push_back(cover.area_m2);
    lengths.push_back(cover.leaf_m);
    EXPECT_LT(*std::max_element(areas.begin(), areas.end()),
              1.2 * *std::min_element(areas.begin(), areas.end()));
    EXPECT_LT(*std::max_element(lengths.begin(), lengths.end()),
              1.05 * *std::min_element(lengths.begin(), lengths.end()));
  }
}

}  // namespace
}  // namespace espalier
