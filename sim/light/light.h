#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sim/light/exposure.h"
#include "sim/light/open_rays.h"
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

/// Whether a sweep of a whole world takes less time than finding the open rays (sim/light/open_rays.h) of so
/// many places in it, whose bricks are not known yet.
bool sweepIsCheaper(Voxel size, std::size_t places);

/// Asks for the light at some places, again and again while a world of one shape fills. There are three ways
/// to find it, and all give the same answer bit for bit.
class LightSensor {
 public:
  LightSensor(const BitVolume& shape, const LightSource& source);

  /// `opaque` must have the shape that was given, and the places must lie in it. Takes the way that costs
  /// least for so many places, with what is kept from the last time. Random rays are always cast.
  /// `filled`: the volume's bricks, from who keeps them (World::opaqueBricks).
  std::vector<Light> at(const BitVolume& opaque, std::span<const Voxel> places, ClearAhead& ahead,
                        const Bricks* filled = nullptr) const;
  /// Each ray walked voxel by voxel: the plain way, without random rays.
  std::vector<Light> byRays(const BitVolume& opaque, std::span<const Voxel> places) const;
  /// As sim/light/open_rays.h does it: for buds.
  std::vector<Light> byOpenRays(const BitVolume& opaque, std::span<const Voxel> places, ClearAhead& ahead,
                                const Bricks* filled = nullptr) const;
  /// The whole world swept: where light is asked for nearly everywhere.
  std::vector<Light> bySweep(const BitVolume& opaque, std::span<const Voxel> places) const;

 private:
  std::vector<Light> lightsOf(std::size_t places,
                              const std::function<std::span<const std::uint64_t>(std::size_t)>& open) const;

  OpenRays rays_;  // the sky's directions, then the sun's
  std::size_t sky_count_;
  std::vector<Outlook> shares_;  // of each of them, if it alone is open
  Lookout sky_, sun_;
  std::optional<RandomSky> random_sky_;
  Weighting weighting_;
};

}  // namespace espalier::sim
