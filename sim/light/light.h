#pragma once
#include <optional>
#include <span>
#include <vector>

#include "sim/light/exposure.h"
#include "sim/light/random_sky.h"
#include "sim/light/sky.h"

namespace espalier::sim {

/// What can be seen of the sky and of the sun's way from a place.
struct Light {
  Outlook sky, sun;
};

/// Where the light of a world comes from: the sky along lattice directions or along Greene's random rays, and
/// the sun's way.
struct LightSource {
  DirectionSet sky, sun;
  std::optional<RandomSky> random_sky = std::nullopt;  ///< instead of the sky's directions
  Weighting weighting = Weighting::uniform;            ///< of the random rays
};

/// Asks for the light at some places, again and again while a world of one shape fills: by casting each ray
/// where the places are few, by sweeping the world where they are many. Both give the same answer bit for
/// bit.
class LightSensor {
 public:
  LightSensor(const BitVolume& shape, const LightSource& source);

  /// `opaque` must have the shape that was given, and the places must lie in it. Random rays are always cast.
  std::vector<Light> at(const BitVolume& opaque, std::span<const Voxel> places) const;
  std::vector<Light> byRays(const BitVolume& opaque, std::span<const Voxel> places) const;
  std::vector<Light> bySweep(const BitVolume& opaque, std::span<const Voxel> places) const;

 private:
  DirectionSet directions_;  // the sky's, then the sun's
  std::size_t sky_count_;
  Lookout sky_, sun_;
  std::optional<RandomSky> random_sky_;
  Weighting weighting_;
};

}  // namespace espalier::sim
