#pragma once
#include <cstddef>
#include <vector>

#include "sim/grow/plant.h"

namespace espalier::sim {

/// A skeleton's way down: each node's children. It follows from the parents, and takes eight bytes a node.
class Kin {
 public:
  Kin() = default;
  explicit Kin(const Skeleton& skeleton) {
    for (const NodeId parent : skeleton.parent) add(parent);
  }

  /// The next node, whose parent this is.
  void add(NodeId parent) {
    const auto node = static_cast<NodeId>(youngest_.size());
    youngest_.push_back(kNoNode);
    elder_.push_back(kNoNode);
    if (parent == kNoNode) return;
    NodeId& youngest = youngest_[static_cast<std::size_t>(parent)];
    elder_.back() = youngest;
    youngest = node;
  }

  /// Calls visit(child) for each child of a node, the youngest first.
  template <typename Visit>
  void forEachChild(NodeId node, Visit visit) const {
    for (NodeId child = youngest_[static_cast<std::size_t>(node)]; child != kNoNode;
         child = elder_[static_cast<std::size_t>(child)])
      visit(child);
  }

 private:
  std::vector<NodeId> youngest_;  // child of each node
  std::vector<NodeId> elder_;     // sibling of each node
};

}  // namespace espalier::sim
