#pragma once
#include <optional>
#include <span>

#include "rules/front/colonize.h"

namespace espalier::bench {

/// The same front as rules::colonize, as one would write it with a library: in each iteration a kd-tree of
/// all nodes is built anew (nanoflann), and every attractor that waits asks it for its nearest node. On all
/// cores. None where nanoflann is not installed. For Acts::on_nearest_node alone, without onto and repeated.
std::optional<rules::Colony> colonizeByKdTree(std::span<const sim::Vec3> attractors, sim::Vec3 start,
                                              const rules::FrontRules& rules, int iterations);

}  // namespace espalier::bench
