#pragma once
#include "render/finish/daylight.h"
#include "sim/base/vec.h"

/// Of surfaces that are seen through, as ice and glass are.
namespace espalier::render {

/// The share of light that a smooth thin film throws back: much where it is seen from the side (Schlick 1994,
/// for a refractive index of 1.33, at both faces). `facing`: cosine between the way to the eye and the
/// normal.
float filmMirror(float facing);

/// What is seen in such a mirror: the sky, or the ground, whose light is given.
sim::Colour mirroredIn(const Daylight& light, sim::Colour ground, sim::Vec3f direction);

/// How bright the sun's image in it is, over the sun's light: both directions unit.
float sunGlint(sim::Vec3f reflected, sim::Vec3f to_sun);

}  // namespace espalier::render
