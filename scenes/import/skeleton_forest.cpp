#include "scenes/import/skeleton_forest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

constexpr double kFarthestPlace = 1e9;  // in the file's unit

/// Children of each node, in the file's order.
struct ChildLists {
  std::vector<std::int32_t> begin, nodes;
};

ChildLists childrenOf(const Forest& forest, const NodeWords& words) {
  const std::size_t count = forest.parent.size();
  ChildLists lists;
  lists.begin.assign(count + 1, 0);
  for (std::size_t n = 0; n < count; ++n) {
    const std::int32_t parent = forest.parent[n];
    if (parent < -1 || parent >= static_cast<std::int32_t>(count)) {
      throw sim::InputError(
          fmt::format("{} has parent {}, and there is no such node; expected {} to {}, or -1 of a "
                      "root",
                      words(n), parent, forest.first, forest.first + static_cast<std::int32_t>(count) - 1));
    }
    if (parent >= 0) ++lists.begin[static_cast<std::size_t>(parent) + 1];
  }
  for (std::size_t n = 0; n < count; ++n) lists.begin[n + 1] += lists.begin[n];
  lists.nodes.resize(static_cast<std::size_t>(lists.begin.back()));
  std::vector<std::int32_t> next(lists.begin.begin(), lists.begin.end() - 1);
  for (std::size_t n = 0; n < count; ++n) {
    if (forest.parent[n] >= 0)
      lists.nodes[static_cast<std::size_t>(next[static_cast<std::size_t>(forest.parent[n])]++)] =
          static_cast<std::int32_t>(n);
  }
  return lists;
}

/// A node on a ring: all that no root leads to hangs on one.
std::size_t onRing(const Forest& forest, const std::vector<bool>& reached) {
  auto n = static_cast<std::size_t>(std::find(reached.begin(), reached.end(), false) - reached.begin());
  for (std::size_t i = 0; i < reached.size(); ++i) n = static_cast<std::size_t>(forest.parent[n]);
  return n;
}

}  // namespace

std::vector<FileTree> treesOf(const Forest& forest, const NodeWords& words) {
  const ChildLists children = childrenOf(forest, words);
  const std::size_t count = forest.parent.size();
  std::vector<bool> reached(count, false);
  std::size_t left = count;
  std::vector<FileTree> trees;
  struct Entry {
    std::int32_t node, parent;  // in the forest, in the tree
  };
  for (std::size_t root = 0; root < count; ++root) {
    if (forest.parent[root] >= 0) continue;
    FileTree tree;
    tree.name = forest.name;
    std::vector<Entry> line{{static_cast<std::int32_t>(root), -1}};
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto [node, parent] = line[i];
      const auto n = static_cast<std::size_t>(node);
      reached[n] = true;
      --left;
      auto own = static_cast<std::int32_t>(tree.parent.size());
      if (parent >= 0 && forest.position[n] == tree.position[static_cast<std::size_t>(parent)]) {
        own = parent;
      } else {
        tree.parent.push_back(parent);
        tree.position.push_back(forest.position[n]);
        if (!forest.radius.empty()) tree.radius.push_back(forest.radius[n]);
        tree.number.push_back(forest.first + node);
      }
      for (std::int32_t c = children.begin[n]; c < children.begin[n + 1]; ++c)
        line.push_back({children.nodes[static_cast<std::size_t>(c)], own});
    }
    if (tree.parent.size() > 1) trees.push_back(std::move(tree));
  }
  if (left > 0)
    throw sim::InputError(
        fmt::format("{} is its own ancestor; expected parents that lead to a root, whose parent is -1",
                    words(onRing(forest, reached))));
  return trees;
}

void requirePlace(sim::Vec3 place, const Words& node) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(place[axis]) <= kFarthestPlace))
      throw sim::InputError(fmt::format("{} stands at [{}, {}, {}]; expected numbers from {:g} to {:g}",
                                        node(), place.x, place.y, place.z, -kFarthestPlace, kFarthestPlace));
  }
}

float soundRadius(double radius, const Words& node) {
  const auto single = static_cast<float>(radius);
  if (!(radius <= kFarthestPlace && single > 0.0f))
    throw sim::InputError(fmt::format("{} has the radius {}; expected more than 0, at most {:g}", node(),
                                      radius, kFarthestPlace));
  return single;
}

}  // namespace espalier::scenes
