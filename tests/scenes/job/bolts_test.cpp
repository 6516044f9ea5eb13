#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/form/formed.h"
#include "scenes/prepare/attractors.h"
#include "scenes/prepare/plantings.h"
#include "scenes/read/read_scene.h"
#include "sim/grow/grow.h"
#include "sim/grow/retiled.h"
#include "tests/support/scratch.h"

/// The library's bolts strike, branch and stray as they should, with other seeds and in coarser worlds too.
namespace espalier::scenes {
namespace {

using sim::NodeId;
using sim::Vec3;

struct Bolt {
  sim::Frame frame;
  sim::BitVolume scene;  ///< what was there before
  sim::Plant grown, formed;
};

Bolt boltOf(const std::string& name, std::uint64_t seed, double coarser, const std::string& mesh = "") {
  auto read = readScene(tests::sourceFolder() / "scenes/library" / (name + ".yaml"));
  if (!read) throw std::runtime_error(format(read.problems()));
  Scene scene = *read;
  scene.seed = seed;
  scene.world.voxel_m = coarser * *scene.world.voxel_m;
  for (SceneMesh& of : scene.meshes) {
    if (!mesh.empty() && of.file.filename() == "wren.obj") of.file.replace_filename(mesh);
  }
  Site site = makeSite(scene);
  const sim::World before = site.world;
  const sim::Growth growth = sim::grow(site.world, makePlantings(scene, site),
                                       growthSettings(scene, site, attractorsOf(scene, site)));
  const render::FormedStand stand = render::formedStand(before, site.world, growth.plants);
  return {before.frame(), before.occupied(), growth.plants.back(), stand.plants.back()};
}

std::size_t at(NodeId n) {
  return static_cast<std::size_t>(n);
}

/// A place along a straight way is rounded to what voxels are tiled by, and may graze one beside it.
void expectClear(const Bolt& bolt) {
  const auto grown = sim::stemVoxels(bolt.grown.skeleton), formed = sim::stemVoxels(bolt.formed.skeleton);
  std::size_t entered = 0;
  for (const sim::Voxel v : formed)
    entered += bolt.scene.at(v) && std::find(grown.begin(), grown.end(), v) == grown.end();
  EXPECT_LE(1000 * entered, formed.size());
}

TEST(Bolts, LeadFromTheCloudToTheHillAndBranchDownwards) {
  for (const auto& [seed, coarser] : {std::pair{std::uint64_t{14}, 1.0}, {29, 1.0}, {14, 1.0 / 0.7}}) {
    const Bolt bolt = boltOf("lightning", seed, coarser);
    const sim::Skeleton& skeleton = bolt.formed.skeleton;
    const std::vector<float>& order = *sim::find(skeleton, "order");
    double lowest = 1e9;
    Vec3 limbs(0.0);
    for (NodeId n = 1; n < skeleton.size(); ++n) {
      lowest = std::min(lowest, sim::worldFromVoxel(bolt.frame, skeleton.position_vx[at(n)]).y);
      const Vec3 way = skeleton.position_vx[at(n)] - skeleton.position_vx[at(skeleton.parent[at(n)])];
      if (order[at(n)] > 0.0f) limbs += way;
    }
    EXPECT_LT(lowest, 12.0 + 3.0 * bolt.frame.voxel_m) << "the hill's top is at 12, seed " << seed;
    EXPECT_GT(*std::max_element(order.begin(), order.end()), 1.5f);
    EXPECT_LT(limbs.y, -0.5 * std::hypot(limbs.x, limbs.z)) << "seed " << seed;
    EXPECT_GT(skeleton.size(), 3 * bolt.grown.skeleton.size()) << "rough ways have more pieces";
    expectClear(bolt);
  }
}

/// All of its ways keep to the skin: of the wren, with another seed and coarser, and of a ball.
TEST(Bolts, CreepOverABody) {
  struct Case {
    std::uint64_t seed;
    double coarser;
    const char* mesh;
  };
  for (const Case& one : {Case{3, 1.0, "wren.obj"}, {8, 1.0 / 0.7, "wren.obj"}, {3, 1.0, "sphere.obj"}}) {
    const Bolt bolt = boltOf("lightning_on_body", one.seed, one.coarser, one.mesh);
    EXPECT_GT(bolt.grown.skeleton.size(), 800);
    double farthest = 0.0;
    sim::World world(bolt.frame);
    std::vector<sim::TiledVoxel> scene;
    const sim::PartId part = world.addPart({"scene", "scene", sim::PartKind::scene, -1});
    for (int y = 0; y < bolt.frame.size.y; ++y) {
      for (int z = 0; z < bolt.frame.size.z; ++z) {
        for (int x = 0; x < bolt.frame.size.x; ++x) {
          if (bolt.scene.at({x, y, z})) scene.push_back({{x, y, z}, {.part = part, .coverage = 1.0f}});
        }
      }
    }
    world.occupy(scene);
    world.setLayers(6);
    for (const Vec3 place : bolt.formed.skeleton.position_vx) {
      const auto near = world.nearnessAt(sim::voxelAt(place));
      farthest = std::max(farthest, near ? static_cast<double>(near->distance_vx) : 99.0);
    }
    EXPECT_LT(farthest, 5.0) << one.mesh;
    EXPECT_GT(bolt.formed.skeleton.size(), 2 * bolt.grown.skeleton.size());
    expectClear(bolt);
  }
}

}  // namespace
}  // namespace espalier::scenes
