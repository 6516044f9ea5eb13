#pragma once
// Internal to the wing, but for FileTree.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::scenes {

/// A tree of a skeleton file, in the file's own unit and axes. Node 0 is its root; a parent's place in the
/// arrays is before its children's.
struct FileTree {
  std::string name;                  ///< what the file calls it; may be empty
  std::vector<std::int32_t> parent;  ///< -1 of the root
  std::vector<sim::Vec3> position;
  std::vector<float> radius;         ///< of the segment that ends in each node; empty: the file has none
  std::vector<std::int32_t> number;  ///< of each node, as the file counts
};

/// The most nodes that a file may have.
inline constexpr std::size_t kMostSkeletonNodes = 4'000'000;

/// Nodes as a file lists them, in any order.
struct Forest {
  std::string name;
  std::vector<std::int32_t> parent;  ///< places in these arrays; -1: a root
  std::vector<sim::Vec3> position;
  std::vector<float> radius;  ///< empty, or of each; a root's means nothing
  std::int32_t first = 0;     ///< what the file calls the first
};

/// What a node is called in messages.
using NodeWords = std::function<std::string(std::size_t node)>;

/// The trees of a forest, by their roots in the file's order; within each, nodes by depth, and of one depth
/// in the order of their parents, then of the file. A node that stands where its parent does is one with it:
/// it has no segment. A root alone is no tree, and left out. Throws sim::InputError for a parent that is not
/// there and for nodes that are their own ancestors.
std::vector<FileTree> treesOf(const Forest& forest, const NodeWords& words);

/// What something is called in messages.
using Words = std::function<std::string()>;

/// Throws sim::InputError unless a place can be used: finite, and no number beyond 1e9.
void requirePlace(sim::Vec3 place, const Words& node);
/// The same of a radius: positive, in single precision too. Gives it in that.
float soundRadius(double radius, const Words& node);

}  // namespace espalier::scenes
