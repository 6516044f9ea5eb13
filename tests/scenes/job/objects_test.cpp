#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "scenes/prepare/attractors.h"
#include "scenes/prepare/plantings.h"
#include "scenes/problem.h"
#include "scenes/read/read_scene.h"
#include "sim/base/sets.h"
#include "sim/grow/grow.h"
#include "sim/scatter/surface_points.h"
#include "sim/sense/scene_surface.h"
#include "tests/support/scratch.h"

/// The library's roads, delta, shell of branches and coral, as they are and by other seeds, on other bodies
/// and in voxels that are 1/0.7 times as wide: each by what makes it one.
namespace espalier::scenes {
namespace {

using sim::Vec3;
using Edits = std::vector<std::pair<std::string, std::string>>;

std::string edited(std::string text, const Edits& edits) {
  for (const auto& [from, to] : edits) {
    const auto at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error("the scene has no " + from);
    text.replace(at, from.size(), to);
  }
  return text;
}

struct Object {
  Site site;
  sim::Growth growth;

  Vec3 metres(Vec3 at_vx) const { return sim::worldFromVoxel(site.world.frame(), at_vx); }
  std::vector<Vec3> nodes_m() const {
    std::vector<Vec3> all;
    for (const sim::Plant& plant : growth.plants) {
      for (const Vec3& at : plant.skeleton.position_vx) all.push_back(metres(at));
    }
    return all;
  }
  std::size_t loops() const {
    std::size_t loops = 0;
    for (const sim::Plant& plant : growth.plants) {
      if (const auto* const joins = sim::find(plant.skeleton, sim::kJoinsColumn))
        loops += static_cast<std::size_t>(
            std::count_if(joins->begin(), joins->end(), [](float n) { return n > 0.0f; }));
    }
    return loops;
  }
};

/// A scene of the library after some edits.
Object made(const std::string& name, const Edits& edits) {
  const tests::Scratch scratch;
  std::string text = tests::fileText(tests::sourceFolder() / "scenes/library" / (name + ".yaml"));
  for (const char* const folder : {"../meshes/", "../../rules/library/"}) {
    const std::string whole = (tests::sourceFolder() / "scenes/library" / folder).lexically_normal().string();
    for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder, at + whole.size()))
      text.replace(at, std::string(folder).size(), whole);
  }
  const auto read = readScene(scratch.write("scene.yaml", edited(text, edits)));
  if (!read) throw std::runtime_error(format(read.problems()));
  Site site = makeSite(*read);
  const auto plantings = makePlantings(*read, site);
  std::vector<NamedPoints> attractors = attractorsOf(*read, site);
  for (NamedPoints& crown : crownsOf(*read, site, plantings)) attractors.push_back(std::move(crown));
  sim::Growth growth = sim::grow(site.world, plantings, growthSettings(*read, site, attractors));
  return {std::move(site), std::move(growth)};
}

/// How far from the nearest of some places each of others lies.
std::vector<double> awayFrom(const std::vector<Vec3>& places, const std::vector<Vec3>& others) {
  std::vector<double> away;
  for (const Vec3 p : others) {
    double nearest2 = INFINITY;
    for (const Vec3 q : places) nearest2 = std::min(nearest2, glm::dot(p - q, p - q));
    away.push_back(std::sqrt(nearest2));
  }
  return away;
}

double shareWithin(const std::vector<double>& away, double reach) {
  return static_cast<double>(std::count_if(away.begin(), away.end(), [&](double d) { return d < reach; })) /
         static_cast<double>(away.size());
}

/// The middles of a picture's pixels, in plan as the scenes lay it, whose density lies in a range.
std::vector<Vec3> pixelsOf(const Object& object, double low, double high) {
  const sim::DensityPicture& picture = object.site.densities.at(0).value();
  std::vector<Vec3> places;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto density =
          static_cast<double>(picture.density[static_cast<std::size_t>(y * picture.width + x)]);
      if (density >= low && density <= high)
        places.emplace_back((x + 0.5) / picture.width * 16000 - 8000, 1,
                            (y + 0.5) / picture.height * 12000 - 6000);
    }
  }
  return places;
}

void expectRoads(const Edits& edits) {
  const Object roads = made("roads", edits);
  EXPECT_GT(roads.loops(), 100u);
  const auto nodes = roads.nodes_m();
  for (const Vec3 at : nodes) ASSERT_NEAR(at.y, 0.0, 1e-6) << "in plan";
  // All that is densely settled has a road near, and the less is settled the farther it is.
  const auto city = awayFrom(nodes, pixelsOf(roads, 0.5, 1.0)),
             land = awayFrom(nodes, pixelsOf(roads, 0.01, 0.1));
  EXPECT_EQ(shareWithin(city, 400.0), 1.0);
  EXPECT_GT(shareWithin(city, 120.0), 2.0 * shareWithin(land, 120.0));
}

TEST(Roads, GoWherePeopleLiveAndMeet) {
  expectRoads({});
  expectRoads({{"seed: 3", "seed: 11"}});
  expectRoads({{"voxel: 30 m", "voxel: 43 m"}});
}

TEST(Roads, HaveNoLoopsWhereTheyDoNotMeet) {
  EXPECT_EQ(made("roads", {{"rules: /", "rules: {colonization: {acts: on_nearest_node}, base: /"},
                           {"roads.yaml, seeds", "roads.yaml}, seeds"},
                           {"spacing: 110 m", "spacing: 300 m"}})
                .loops(),
            0u);
}

/// In each direction from the apex channels come as far as there is silt for them.
void expectDelta(const Edits& edits) {
  const Object delta = made("delta", edits);
  const Vec3 apex(0, 1, -2900);
  constexpr int kSectors = 9;
  const auto reaches = [&](const std::vector<Vec3>& places) {
    std::vector<double> far(kSectors, 0.0);
    for (const Vec3 p : places) {
      const double way = std::atan2(p.x - apex.x, p.z - apex.z);  // 0 is south, where the sea is
      const int sector = static_cast<int>(std::floor((way / 1.1 + 1.0) / 2.0 * kSectors));
      if (sector >= 0 && sector < kSectors)
        far[static_cast<std::size_t>(sector)] =
            std::max(far[static_cast<std::size_t>(sector)], glm::distance(p, apex));
    }
    return far;
  };
  const auto coast = reaches(pixelsOf(delta, 0.3, 1.0)), channels = reaches(delta.nodes_m());
  for (std::size_t i = 0; i < kSectors; ++i) EXPECT_GT(channels[i], coast[i] - 500.0) << i;
  EXPECT_GT(delta.loops(), 20u);
  // Bars stay free: no channel runs along their middles.
  std::size_t mouths = 0;
  const sim::Skeleton& river = delta.growth.plants.at(0).skeleton;
  std::vector<int> children(river.position_vx.size(), 0);
  for (const sim::NodeId parent : river.parent) {
    if (parent != sim::kNoNode) ++children[static_cast<std::size_t>(parent)];
  }
  const auto sea = pixelsOf(delta, 0.0, 0.0);
  std::vector<Vec3> tips;
  for (std::size_t n = 0; n < children.size(); ++n) {
    const Vec3 at = delta.metres(river.position_vx[n]);
    if (children[n] == 0 && at.z > 0.0) tips.push_back(at);
  }
  for (const double away : awayFrom(sea, tips)) mouths += away < 250.0;
  EXPECT_GT(mouths, 8u);
}

TEST(Delta, FansOutToTheCoastInEveryDirection) {
  expectDelta({});
  expectDelta({{"seed: 3", "seed: 12"}});
  expectDelta({{"voxel: 30 m", "voxel: 20 m"}});
}

void expectShell(const Edits& edits, double reach_m) {
  const Object shell = made("branch_shell", edits);
  const sim::Mesh& body = shell.site.meshes.at(0).mesh;
  const auto nodes = shell.nodes_m();
  EXPECT_GT(shell.loops(), 50u);
  // All over the body, and nowhere else: within what the rules say of its surface.
  EXPECT_GT(shareWithin(awayFrom(nodes, sim::scatterOn(body, 1500, 1).at), reach_m), 0.95);
  for (std::size_t i = 0; i < nodes.size(); i += 7) {
    double off = INFINITY;
    for (const auto& [a, b, c] : body.triangles)
      off = std::min(
          off,
          glm::distance(nodes[i], sim::nearestOn({body.vertices_m[a], body.vertices_m[b], body.vertices_m[c]},
                                                 nodes[i])));
    ASSERT_LT(off, 0.0101);
  }
  // The roots' branches hang together.
  const auto& plants = shell.growth.plants;
  sim::Sets sets(plants.size());
  for (std::size_t a = 0; a < plants.size(); ++a) {
    const auto& places = plants[a].skeleton.position_vx;
    for (std::size_t b = 0; b < a; ++b) {
      const auto& others = plants[b].skeleton.position_vx;
      if (std::find_first_of(places.begin(), places.end(), others.begin(), others.end()) != places.end())
        sets.join(a, b);
    }
  }
  for (std::size_t a = 1; a < plants.size(); ++a) EXPECT_EQ(sets.of(a), sets.of(0)) << a;
}

const Edits kSparse{{"spacing: 3 cm, waves: 3", "spacing: 4 cm, waves: 2"}};

Edits andSparse(Edits edits) {
  edits.insert(edits.end(), kSparse.begin(), kSparse.end());
  return edits;
}

TEST(BranchShell, CoversABodyAndGrowsTogether) {
  expectShell(kSparse, 0.06);
  expectShell(andSparse({{"seed: 4", "seed: 5"}}), 0.06);
  expectShell(andSparse({{"voxel: 1 cm", "voxel: 1.43 cm"}}), 0.06);
}

TEST(BranchShell, CoversAnotherBody) {
  const Edits ball{{"wren.obj, name: wren", "sphere.obj, scale: 0.6, name: wren"},
                   {"[[0.098, -0.2545, 0.094], [0.046, -0.261, -0.114], [-0.143, -0.286, 0.021]]",
                    "[[0, 0.3, 0], [0, -0.29, 0.07], [-0.29, 0, 0.07]]"}};
  expectShell(andSparse(ball), 0.06);
}

/// Colonies stand all over the body, outside of it, and reach away from it.
void expectCoral(const Edits& edits) {
  const Object coral = made("coral", edits);
  std::size_t grown = 0;
  double foot_m = 0.0, tip_m = 0.0;
  const sim::World& world = coral.site.world;
  const Vec3 middle = [&] {
    Vec3 sum(0.0);
    const auto& corners = coral.site.meshes.at(0).mesh.vertices_m;
    for (const Vec3 corner : corners) sum += corner;
    return sum / static_cast<double>(corners.size());
  }();
  for (const sim::Plant& plant : coral.growth.plants) {
    const auto& places = plant.skeleton.position_vx;
    grown += places.size() > 5;
    foot_m += glm::distance(coral.metres(places.front()), middle);
    double farthest = 0.0;
    for (const Vec3 at : places) {
      farthest = std::max(farthest, glm::distance(coral.metres(at), middle));
      const sim::Voxel v = sim::voxelAt(at);
      ASSERT_FALSE(world.occupied().at(v) && world.part(world.partAt(v)).plant == sim::kNoPlant);
    }
    tip_m += farthest;
  }
  const auto count = static_cast<double>(coral.growth.plants.size());
  EXPECT_GT(static_cast<double>(grown), 0.85 * count);
  EXPECT_GT((tip_m - foot_m) / count, 0.08);
}

TEST(Coral, GrowsOutwardsFromABody) {
  expectCoral({});
  expectCoral({{"seed: 6", "seed: 7"}});
  expectCoral({{"voxel: 1 cm", "voxel: 1.43 cm"}});
  const Edits on_a_wren{
      {"reef.obj, solid: true, translate: [0, -0.3, 0]", "wren.obj, solid: true, translate: [0, 0.3, 0]"}};
  Edits wren = on_a_wren;
  for (int i = 0; i < 3; ++i) wren.push_back({"region: reef", "region: wren"});
  expectCoral(wren);
}

}  // namespace
}  // namespace espalier::scenes
