#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sim/grow/plant.h"

namespace espalier::render {

/// What becomes of the segment that ends in a node.
struct Reshaped {
  /// Where it starts, if not in the place of the node's parent: in point `point` of the way of a node farther
  /// on.
  struct Start {
    sim::NodeId way = sim::kNoNode;
    std::size_t point = 0;
  };
  std::optional<Start> start;
  std::vector<sim::Vec3> through;  ///< places that it passes after its start, the last the node's own
  std::vector<double> shares;  ///< where each was on the segment as it grew, 0 to 1, rising; the last is 1
};

/// A plant of which the segments go other ways: one for each node; of a seed the one place where it stands.
/// New nodes are born with the one whose segment they are on, and have its quantities. Elements go along with
/// the places on which they stood.
sim::Plant reshaped(const sim::Plant& plant, std::span<const Reshaped> ways);

/// Of a skeleton whose segments were cut into pieces: which of its nodes join which (sim::kJoinsColumn).
/// `number`: the new one of an old node.
void renumberJoins(const sim::Skeleton& old, const std::function<sim::NodeId(sim::NodeId)>& number,
                   sim::Skeleton& now);
/// Nodes that join others come to where these are now.
void meetAgain(sim::Skeleton& skeleton);

}  // namespace espalier::render
