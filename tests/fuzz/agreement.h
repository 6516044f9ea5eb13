#pragma once
#include "tests/fuzz/drawn.h"
#include "tests/support/numbers.h"

namespace espalier::fuzz {

/// Makes keys of a scene that were drawn apart agree more often than chance would have it, or the checks
/// would take most of them out again: images name plants and images that are there, a sun is
/// of one kind, and what needs an inside names a mesh that has one. Now and then it does not.
void makeAgree(Drawn& scene, tests::Numbers& numbers);

/// Leaves a crown one solid of those that were drawn, or makes it a sphere.
void agreeOnCrown(Drawn& crown, const std::string& radius, tests::Numbers& numbers);

/// Gives an element something to be, and one way to say how many there are.
void agreeOnElement(Drawn& element, tests::Numbers& numbers);

/// Puts the bounds of what a rule set requires in order, where they are written alike; limbs wander by one
/// distribution, and distances are to what does not touch a tip.
void agreeOnRules(Drawn& rules);

/// Gives a pull either a place or a way.
void agreeOnPull(Drawn& pull, tests::Numbers& numbers);

}  // namespace espalier::fuzz
