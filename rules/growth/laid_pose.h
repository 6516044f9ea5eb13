#pragma once
#include "rules/diffusion/ground.h"
#include "rules/language/rule_set.h"
#include "sim/grow/plant.h"

namespace espalier::rules {

/// How far something leans, and to which side, in full turns.
struct Tilt {
  double degrees = 0.0, side = 0.0;
};

/// Turns an element's axes as its pose says, on a surface, its own way about that pose as the stance's +y
/// goes; then all of it leans. `light`: unit, towards the brightest part of the sky; zero where none is seen.
void poseOn(const Stance& stance, Pose pose, sim::Vec3 light, Tilt tilt, sim::PlacedElement& element);

/// Lifts what lies flat out of its surface: its lowest corner comes to lie on it, of what is no body a hair
/// above.
void liftOnto(const Stance& stance, const Element& rule, sim::PlacedElement& element);

}  // namespace espalier::rules
