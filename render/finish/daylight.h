#pragma once
#include "sim/base/bits.h"
#include "sim/base/frame.h"
#include "sim/base/vec.h"
#include "sim/world/field.h"

namespace espalier::render {

/// A clear morning: the sun's and the sky's light on a surface that faces them, and the sky as it is seen.
struct Daylight {
  sim::Vec3f to_sun{0.0f, 1.0f, 0.0f};            ///< unit
  sim::Colour sun{1.68f, 1.40f, 1.04f};           ///< light on a surface square to the sun
  sim::Colour zenith_light{0.34f, 0.41f, 0.52f};  ///< light of the whole sky on a surface that looks up
  sim::Colour side_light{0.37f, 0.39f, 0.41f};    ///< the same for one that looks to the side
  sim::Colour horizon{0.84f, 0.83f, 0.78f};       ///< seen; also the haze's colour
  sim::Colour zenith{0.15f, 0.33f, 0.60f};        ///< seen
};

/// How much of a clear morning's light there is, by channel: dusk, night, an overcast day.
struct DaylightShare {
  sim::Colour sky{1.0f}, sun{1.0f};
};

/// A morning with the sun there, which need not be of unit length; below the horizon there is no sun.
Daylight daylightOf(sim::Vec3 to_sun, const DaylightShare& share);

/// The sky behind everything, in a unit direction; below the horizon there is haze.
sim::Colour skySeen(const Daylight& light, sim::Vec3f direction);

/// How much of the sky a fragment sees: the sky_exposure of the free voxels in front of it, interpolated
/// (each fragment lit by its voxel: Greene 1989, section 5).
class SkyView {
 public:
  /// Borrows both, which must have the frame's size.
  SkyView(const sim::Frame& frame, const sim::BitVolume& occupied, const sim::ExposureField& sky)
      : frame_(frame),
        occupied_(occupied),
        sky_(sky),
        last_(frame.size - 1),
        open_at_vx_(0.5 * glm::length(last_)) {}

  /// `normal` is unit and points into the free space. 0..1; well outside the world 1.
  float at(sim::Vec3 p_m, sim::Vec3f normal) const;

 private:
  bool amongFree(sim::Vec3 p_vx, float& exposure) const;

  const sim::Frame& frame_;
  const sim::BitVolume& occupied_;
  const sim::ExposureField& sky_;
  sim::Vec3 last_;     ///< the last voxel's centre
  double open_at_vx_;  ///< so far outside the sky is open
};

}  // namespace espalier::render
