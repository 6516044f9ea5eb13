#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "scenes/prepare/plantings.h"
#include "scenes/problem.h"
#include "scenes/read/read_scene.h"
#include "sim/grow/grow.h"
#include "tests/support/scratch.h"

/// The line tracker of figure 9's railing (Greene 1989, section 7) on line graphs drawn at random.
namespace espalier::scenes {
namespace {

using sim::Vec3;

/// Lines from each node but the first to its parent.
struct Graph {
  std::vector<Vec3> nodes_m;
  std::vector<std::size_t> parent;
};

constexpr double kVoxel_m = 0.04, kSide_m = 96 * kVoxel_m;

class Drawing {
 public:
  explicit Drawing(unsigned seed) : random_(seed) {}

  /// Upright at first; then lines fork in two, or in three as often as that, into the plane or into space.
  Graph graph(bool in_space, double threes) {
    threes_ = threes;
    constexpr std::size_t kLines = 11;
    while (true) {
      Graph graph{{{kSide_m / 2, 0.16, kSide_m / 2}}, {0}};
      add(graph, 0, Vec3(0, 0.56 + uniform(0.0, 0.24), 0));
      for (std::size_t at = 1; at < graph.nodes_m.size() && graph.nodes_m.size() <= kLines; ++at)
        fork(graph, at, in_space);
      if (graph.nodes_m.size() > kLines) return graph;
    }
  }

 private:
  static constexpr double kApart_m = 6 * kVoxel_m;  // lines that do not meet

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / 0x1p32;
  }
  static void add(Graph& graph, std::size_t parent, Vec3 way_m) {
    graph.nodes_m.push_back(graph.nodes_m[parent] + way_m);
    graph.parent.push_back(parent);
  }

  void fork(Graph& graph, std::size_t at, bool in_space) {
    std::vector<Vec3> ways;
    const std::size_t wanted = uniform(0.0, 1.0) < threes_ ? 3 : 2;
    for (int tries = 0; tries < 300 && ways.size() < wanted; ++tries) {
      const Vec3 way(uniform(-1, 1), uniform(-1, 1), in_space ? uniform(-1, 1) : 0.0);
      if (glm::length(way) > 1.0 || glm::length(way) < 0.1) continue;
      const Vec3 line = uniform(0.5, 0.85) * glm::normalize(way);
      if (isClear(graph, at, ways, line)) ways.push_back(line);
    }
    if (ways.size() < 2) return;
    for (const Vec3 way : ways) add(graph, at, way);
  }

  /// Inside, 50 degrees off what meets it and apart from all else.
  static bool isClear(const Graph& graph, std::size_t at, const std::vector<Vec3>& ways, Vec3 line) {
    constexpr double kLeast = 0.643;  // the cosine
    const Vec3 from = graph.nodes_m[at], to = from + line;
    for (int axis = 0; axis < 3; ++axis) {
      if (to[axis] < 0.3 || to[axis] > kSide_m - 0.3) return false;
    }
    const auto turns = [&](Vec3 other) {
      return glm::dot(glm::normalize(other), glm::normalize(line)) < kLeast;
    };
    if (!turns(graph.nodes_m[graph.parent[at]] - from)) return false;
    for (const Vec3 way : ways) {
      if (!turns(way)) return false;
    }
    for (std::size_t n = 1; n < graph.nodes_m.size(); ++n) {
      const double start = n == at || graph.parent[n] == at ? 0.5 : 0.25;
      for (int i = 0; i <= 20; ++i) {
        for (int k = 0; k <= 20; ++k) {
          const Vec3 here = glm::mix(from + start * line, to, i / 20.0);
          const Vec3 there = glm::mix(graph.nodes_m[graph.parent[n]], graph.nodes_m[n], k / 20.0);
          if (glm::distance(here, there) < kApart_m) return false;
        }
      }
    }
    return true;
  }

  std::mt19937 random_;
  double threes_ = 0.0;
};

std::size_t forksOf(const Graph& graph) {
  std::vector<int> leave(graph.nodes_m.size());
  for (std::size_t n = 1; n < graph.nodes_m.size(); ++n) ++leave[graph.parent[n]];
  return static_cast<std::size_t>(
      std::count_if(leave.begin(), leave.end(), [](int lines) { return lines > 1; }));
}

std::string sceneOf(const Graph& graph) {
  const auto point = [](Vec3 p) { return fmt::format("[{:.6f}, {:.6f}, {:.6f}]", p.x, p.y, p.z); };
  std::string lines;
  for (std::size_t n = 1; n < graph.nodes_m.size(); ++n)
    lines +=
        fmt::format("      - [{}, {}]\n", point(graph.nodes_m[graph.parent[n]]), point(graph.nodes_m[n]));
  return fmt::format(
      "espalier: scene\niterations: 200\n"
      "world: {{voxel: {} cm, bounds: {{min: [0, 0, 0], max: [{}, {}, {}]}}}}\n"
      "meshes:\n  - name: sketch\n    guide: true\n    lines:\n{}"
      "plants:\n  - {{rules: line_tracker, seeds: [{}]}}\n",
      100 * kVoxel_m, kSide_m, kSide_m, kSide_m, lines, point(graph.nodes_m[0] + Vec3(0, kVoxel_m, 0)));
}

std::size_t branchingsOf(const sim::Plant& plant) {
  std::vector<int> limbs(plant.skeleton.parent.size());
  for (const sim::NodeId parent : plant.skeleton.parent) {
    if (parent != sim::kNoNode) ++limbs[static_cast<std::size_t>(parent)];
  }
  return static_cast<std::size_t>(
      std::count_if(limbs.begin(), limbs.end(), [](int count) { return count > 1; }));
}

struct Tracked {
  int graphs = 0, equal = 0;  ///< equal: with as many branchings as forks
  std::size_t forks = 0, branchings = 0;
};

Tracked tracked(double threes) {
  const tests::Scratch scratch;
  Tracked all;
  for (unsigned i = 0; i < 20; ++i) {
    const Graph graph = Drawing(i).graph(i % 2 == 1, threes);
    auto scene = readScene(scratch.write("graph.yaml", sceneOf(graph)));
    if (!scene) throw std::runtime_error(format(scene.problems()));
    Site site = makeSite(*scene);
    const auto plantings = makePlantings(*scene, site);
    const sim::Growth growth = sim::grow(site.world, plantings, growthSettings(*scene, site, {}));
    const std::size_t branchings = branchingsOf(growth.plants.at(0)), forks = forksOf(graph);
    ++all.graphs;
    all.equal += branchings == forks;
    all.forks += forks;
    all.branchings += branchings;
  }
  return all;
}

TEST(LineTracker, BranchesWhereRandomLinesForkAndNowhereElse) {
  const Tracked two = tracked(0.0);
  EXPECT_EQ(two.equal, two.graphs);
  EXPECT_EQ(two.branchings, two.forks);
  EXPECT_GT(two.forks, 90u);
}

TEST(LineTracker, SeldomMissesOneOfThreeWays) {
  const Tracked three = tracked(0.3);
  EXPECT_GE(three.equal, 17);
  EXPECT_LE(three.branchings, three.forks);
  EXPECT_GT(three.forks, 80u);
}

TEST(LineTracker, SaysWhereThereAreNoLines) {
  const tests::Scratch scratch;
  std::string text = sceneOf(Drawing(0).graph(false, 0.0));
  const std::size_t meshes = text.find("meshes:"), plants = text.find("plants:");
  text.erase(meshes, plants - meshes);
  auto scene = readScene(scratch.write("bare.yaml", text));
  ASSERT_TRUE(scene) << format(scene.problems());
  const Site site = makeSite(*scene);
  try {
    makePlantings(*scene, site);
    FAIL() << "it grew on no lines";
  } catch (const PlacedError& error) {
    const std::string said = scratch.shown(error.problems());
    EXPECT_EQ(said.find("bare.yaml:5:13: "), 0u) << said;
    EXPECT_NE(said.find("senses are of: lines, and the scene has none; expected a mesh with lines"),
              said.npos)
        << said;
  }
}

}  // namespace
}  // namespace espalier::scenes
