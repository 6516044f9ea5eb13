#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "render/model/stem_line.h"
#include "sim/grow/plant.h"

namespace espalier::render {

/// A stem from its fork (or seed) to its tip: at each node the thickest child continues it, the straightest
/// among equals; every other child begins a stem of its own. Nodes in one place are one.
struct StemCurve {
  std::vector<sim::NodeId> nodes;  ///< from the fork or seed outwards, at least two in different places
  StemLine curve;                  ///< through the nodes, voxel space; node i at parameter i
  bool from_seed = false;          ///< the thickest stem of a seed; its others fork from that one
  /// Of branching, 0 to 255: as the process counts it (the column "order" at its first node); else 0 for one
  /// from a seed and one more at each fork.
  std::uint8_t order = 0;
};

struct StemCurves {
  std::vector<StemCurve> stems;  ///< a stem comes after the one it forks from
  /// Where each generation of stems begins: those of seeds, those that fork from them, and so on; then their
  /// number.
  std::vector<std::size_t> generations;
  std::vector<std::int32_t> stem_of;  ///< per node: the stem that its own segment lies on, -1 for a lone seed
  std::vector<double> parameter_of;   ///< per node: where on that stem

  /// That of the stem that a node's own segment lies on; 0 for a lone seed.
  std::uint8_t orderAt(sim::NodeId node) const;
};

/// `radii` as from stemRadii. `blocked`: what curves keep out of where the skeleton does; empty: nothing.
StemCurves stemCurves(const sim::Skeleton& skeleton, std::span<const float> radii,
                      const Blocked& blocked = {});

}  // namespace espalier::render
