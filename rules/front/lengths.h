#pragma once
#include "rules/front/attractors.h"

namespace espalier::rules {

/// How far an attractor is from the nearest other one: the median over all of them, or over some 4,000 along
/// their curve. 0 where there is but one, or most lie in one place.
double spacingOf(const Attractors& attractors);

/// Lengths that suit attractors so far apart, evenly strewn in space (where they are then (ln 2 / (4/3 pi
/// n))^(1/3) = 0.55 n^(-1/3) from each other): half, once and six times the edge of the cube that each has
/// for itself. So a tree's shape does not depend on how large it is.
struct FrontLengths {
  double step = 0.0, influence = 0.0, kill = 0.0;
};
FrontLengths suitableLengths(double spacing);

}  // namespace espalier::rules
