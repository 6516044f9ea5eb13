#pragma once
#include <functional>
#include <vector>

#include "sim/light/sky.h"
#include "sim/sweep/directions.h"

/// How bright the sky is behind what a tip sees of it: Greene's table of background illumination (Voxel Space
/// Automata, 1989, section 6 and figure 7).
namespace espalier::sim {

/// Radiance of the open sky towards a unit direction with y > 0, in any unit; not below 0.
using Background = std::function<double(Vec3 unit)>;

/// The sky that a weighting stands for: alike everywhere, or brighter towards the zenith (CIE overcast).
Background backgroundOf(Weighting weighting);

/// 1 at the zenith and `horizon` at the horizon, in between by the sine of the elevation.
Background gradient(double horizon);

/// A picture of the sky by latitude and longitude: radiances from the zenith (the first row) to the horizon,
/// all around from left to right.
struct SkyPicture {
  static constexpr int kRows = 90, kColumns = 360;  ///< a degree each
  std::vector<float> radiance;                      ///< row by row

  friend bool operator==(const SkyPicture&, const SkyPicture&) = default;
};

/// `turn_deg`: the compass way of the picture's middle: 0 is -z, 90 is +x. From there to the right one turns
/// as the compass does.
Background pictured(SkyPicture picture, double turn_deg);

/// A band of light along the sun's way.
struct SunBand {
  double brightness = 0.0;  ///< in its middle, times the mean of the sky without it
  double width_deg = 20.0;  ///< across; less and less towards its rims
};

/// That sky with such a band before it. `sun`: the places of the sun.
Background withBand(Background sky, const DirectionSet& sun, const SunBand& band);

}  // namespace espalier::sim
