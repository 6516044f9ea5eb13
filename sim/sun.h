#pragma once
#include <string>
#include <vector>

#include "sim/directions.h"

namespace espalier::sim {

/// The sun's way as a set of directions.
struct Sun {
  DirectionSet directions;    ///< weighted as was asked; add up to kWhole; empty for a sun that never rises
  std::vector<double> hours;  ///< of sun that each direction stands for, a day on average over its days
  double worst_angle_deg = 0.0;  ///< between a place of the sun and the direction that stands for it
  std::string about;             ///< which sun it is: "sun on 2026-06-21 at 47.37 N 8.54 E"

  double totalHours() const;
};

/// Greene's sun: a half circle from horizon to horizon through a point `tilt_deg` from the zenith (0 <= tilt
/// < 90), leaning to the compass way `toward_deg` (0 = -z, 90 = +x, 180 = +z, 270 = -x); evenly sampled over
/// 12 hours.
struct SunArc {
  double tilt_deg = 20.0;
  double toward_deg = 180.0;
  int samples = 48;
};

/// Unit direction to the sun at an hour of the day: 6 sunrise, 12 the top of the arc, 18 sunset.
Vec3 sunDirection(const SunArc& arc, double hour);
Sun makeSun(const SunArc& arc);

/// For legends, reports and metadata: "sun on 2026-06-21 at 47.37 N 8.54 E, 15.8 h a day, 31 directions
/// within 0.5 degrees".
std::string describe(const Sun& sun);

}  // namespace espalier::sim
