#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sim/grow/plant.h"

namespace espalier::rules {

/// A tree that somebody else made. Node 0 is its root; a parent's number is lower than its child's.
struct GivenTree {
  std::vector<sim::NodeId> parent;  ///< kNoNode of the root
  std::vector<sim::Vec3> position_vx;
  std::vector<float> radius_vx = {};  ///< of the segment that ends in each node; empty: none is known
};

/// The same, with all that its growing follows from. Its nodes have the numbers that they will have in the
/// plant: they are placed one after another.
struct ArrangedTree {
  GivenTree tree;
  /// The limb that goes on at a node is the thickest of its children, without radii the one that carries most
  /// tips; of equal ones the straightest. The others are branches of the next order.
  std::vector<std::int32_t> order;
  std::vector<std::int32_t> number;     ///< of each node among its parent's children, the limb first
  std::vector<std::int32_t> iteration;  ///< in which it is placed
  std::vector<std::int32_t>
      wave;  ///< counts up; those of one wave are placed together, on what stands before

  std::int32_t size() const { return static_cast<std::int32_t>(order.size()); }
};

/// Has trees grow from their roots at one speed along their limbs, so that the farthest tip of all is reached
/// in the last of the iterations.
std::vector<ArrangedTree> arranged(std::vector<GivenTree> trees, int iterations);

}  // namespace espalier::rules
