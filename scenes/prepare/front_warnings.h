#pragma once
#include <vector>

#include "scenes/prepare/attractors.h"
#include "scenes/problem.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// Where lengths that rules give to a front cannot work among the attractors that it grows to, each with its
/// place in the scene's file and with lengths that would: a kill distance within which no step ends, an
/// influence radius that reaches from hardly any attractor to the next, a step beyond the influence radius, a
/// kill distance as wide as the crown.
std::vector<Problem> frontWarnings(const Scene& scene, const sim::Frame& frame,
                                   const std::vector<NamedPoints>& attractors);

}  // namespace espalier::scenes
