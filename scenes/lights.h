#pragma once
#include <optional>

#include "render/finish/daylight.h"
#include "scenes/scene.h"
#include "sim/light/background.h"
#include "sim/light/brightest.h"
#include "sim/light/random_sky.h"
#include "sim/light/sky.h"
#include "sim/light/sun.h"

/// The sky and the sun that a scene asks for.
namespace espalier::scenes {

sim::SkySettings skySettings(const SkySpec& spec);
/// Where the scene asks for random rays.
std::optional<sim::RandomSky> randomSky(const SkySpec& spec, std::uint64_t seed);

/// What is behind what a tip sees of the sky. `picture`: of its file, where the scene names one.
sim::Background backgroundOf(const SkySpec& spec, const std::optional<sim::SkyPicture>& picture,
                             const sim::DirectionSet& sun);
/// Greene's table with that background, as growth makes it: 9 rows of 10 degrees above the horizon, all
/// around.
sim::SkyTable skyTableOf(const sim::Background& background);

/// Throws sim::InputError for a sun that makes no sense or is never up.
sim::Sun makeSun(const SunSpec& spec);
/// What of a clear morning's light there is in images of vines.
render::DaylightShare daylightShare(const Scene& scene);
/// To the sun at an hour of the (first) day.
sim::Vec3 sunDirection(const SunSpec& spec, double hour);
/// To the sun at the hour of shadow mattes.
sim::Vec3 shadowDirection(const SunSpec& spec);

}  // namespace espalier::scenes
