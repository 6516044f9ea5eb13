#pragma once
#include "render/form/formed.h"
#include "sim/grow/plant.h"

namespace espalier::render {

/// The angles, in radians, between the way of a vessel of radius r0 and its two daughters where the three
/// cost least (Murray 1926): cos a = (r0^4 + r1^4 - r2^4) / (2 r0^2 r1^2), and b likewise. Their sum has the
/// cosine (r0^4 - r1^4 - r2^4) / (2 r1^2 r2^2). Radii above 0.
struct ForkAngles {
  double first = 0.0, second = 0.0;
};
ForkAngles murrayAngles(double r0, double r1, double r2);

/// A stem is straight for as many of its radii before it forks, and as many of these behind the fork too.
inline constexpr double kStraightRadii = 3.3;

/// A plant whose forks have Murray's angles, by the radii that its girth gives; in the plane in which they
/// forked, or the next to it that has room. Its forks stay where they are, and its tips but for those of
/// twigs so short that they are straight altogether. Where more than two daughters left a node, only two
/// still do; the others leave the thickest a little farther on. A stretch is straight at both ends as far as
/// its length allows, and bends in between, back to where it grew. One that would enter what is blocked is
/// less so, or not at all.
sim::Plant withMurrayForks(const sim::Plant& plant, const KeptFree& blocked);

}  // namespace espalier::render
