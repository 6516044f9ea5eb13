#pragma once
#include <vector>

#include "render/form/formed.h"
#include "render/form/reshaped.h"
#include "sim/grow/plant.h"

namespace espalier::render {

/// A limb from one fork (or a seed) to the next (or a tip).
struct Stretch {
  sim::NodeId from = sim::kNoNode;  ///< the fork or seed in which it starts
  std::vector<sim::NodeId> nodes;   ///< on it, from there on; the last forks or is a tip
  std::vector<sim::Vec3> points;    ///< of `from` and those
  std::vector<double> arcs;         ///< how far each point is along it, from 0, voxel widths

  double length() const { return arcs.back(); }
  /// The place so far along; its ends beyond them.
  sim::Vec3 at(double arc) const;
};

/// All of a skeleton's, by the order of their first nodes.
std::vector<Stretch> stretchesOf(const sim::Skeleton& skeleton);

/// Whether a straight piece enters what is blocked.
bool enters(sim::Vec3 from_vx, sim::Vec3 to_vx, const KeptFree& blocked);

/// Every segment as it grew.
std::vector<Reshaped> asGrown(const sim::Skeleton& skeleton);

}  // namespace espalier::render
