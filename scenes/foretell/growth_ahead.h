#pragma once
#include <span>

#include "sim/grow/plant.h"
#include "sim/world/ray.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// The bricks in which there is free space beside a surface.
sim::Bricks bricksNearSurfaces(const sim::World& world);

/// How many segments plants will have, grown for `iterations` until now, after `more` of them.
///
/// Growth is foretold brick by brick. A brick that plants have come into fills with age as others did before
/// it, and what is older than any is yet slows down. Plants come into new bricks along the trend of late,
/// whose slope wears off (a damped trend, after Gardner and McKenzie 1985), until all are taken that can be
/// reached: those near surfaces, which `near` has for the world before anything grew, that follow each other
/// from where plants are; or all of the world, where plants keep to no surfaces.
double segmentsAhead(std::span<const sim::Plant> plants, const sim::Bricks& near, int iterations, int more);

}  // namespace espalier::scenes
