#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rules/front/front.h"

/// The front alone, with no world around it.
namespace espalier::rules {

/// An out-tree for each start: a node's parent has a lower number.
struct Colony {
  std::vector<sim::Vec3> position;
  std::vector<std::int32_t> parent;  ///< kNobody for a start
  std::vector<std::int32_t> born;    ///< iteration, from 0; of a start 0
  std::vector<std::int32_t> joins;   ///< of a node that closes a loop the one whose place it stands in; else
                                     ///< kNobody
  int iterations = 0;
  Fates fates;
};

/// Grows from all starts at once until nothing is in reach, or for so many iterations. The same to the bit
/// for any order of the attractors (but those in one place) and any number of threads. Throws sim::InputError
/// for rules that are not positive or not numbers, for places that are not finite, and where there is no
/// start or no attractor. `waves`, if there are any: of each attractor, in which it comes.
Colony colonize(std::span<const sim::Vec3> attractors, std::span<const sim::Vec3> starts, FrontRules rules,
                int iterations, std::span<const std::int32_t> waves = {});

}  // namespace espalier::rules
