#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "render/image/graph_drawing.h"
#include "rules/front/attractors.h"
#include "sim/base/frame.h"
#include "sim/grow/growth.h"

/// The nodes and attractors of a growth as they stood after each of its iterations.
namespace espalier::scenes {

struct SeenAttractor {
  render::SpacePoint point;
  rules::Fate fate = rules::Fate::waiting;
  std::int32_t ended = -1;  ///< the iteration in which it did; -1 while it waits
};

/// All that ever stood, and since when.
struct GrowthGraph {
  std::vector<render::SpaceNode> nodes;   ///< of all plants, whatever they grow by
  std::vector<std::int32_t> born;         ///< of each node: the iteration
  std::vector<SeenAttractor> attractors;  ///< of all sets, in the order of their names and as they were given
  /// Their names, and how many are in each: "crown, 1000; hedge, 200"; of more than three: "1200 in 8 sets".
  std::string sets;
};

/// Nothing in it is hidden yet.
GrowthGraph growthGraph(const sim::Growth& growth, const sim::Frame& frame);

/// What stands after so many iterations: starts, and what was born before; attractors that had not ended
/// before wait, and those on which a node stands are left out.
render::PointGraph graphAfter(const GrowthGraph& whole, std::int32_t iterations);

}  // namespace espalier::scenes
