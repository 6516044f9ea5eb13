#pragma once
#include <optional>

#include "scenes/scene.h"
#include "sim/light/random_sky.h"
#include "sim/light/sky.h"
#include "sim/light/sun.h"

/// The sky and the sun that a scene asks for.
namespace espalier::scenes {

sim::SkySettings skySettings(const SkySpec& spec);
/// Where the scene asks for random rays.
std::optional<sim::RandomSky> randomSky(const SkySpec& spec, std::uint64_t seed);

/// Throws sim::InputError for a sun that makes no sense or is never up.
sim::Sun makeSun(const SunSpec& spec);
/// To the sun at an hour of the (first) day.
sim::Vec3 sunDirection(const SunSpec& spec, double hour);
/// To the sun at the hour of shadow mattes.
sim::Vec3 shadowDirection(const SunSpec& spec);

}  // namespace espalier::scenes
