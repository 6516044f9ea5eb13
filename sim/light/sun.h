#pragma once
#include <chrono>
#include <string>
#include <vector>

#include "sim/sweep/directions.h"

/// Suns: Greene's inclined arc, and the real one over a place of the earth. A direction leads to the sun:
/// y is up, and -z lies to the north unless `north_deg` says otherwise.
namespace espalier::sim {

/// The year of a day that is named without one: that of the tables which NOAA's and Ladybug's users compare.
inline constexpr std::chrono::year kUsualYear{2017};

/// "2026-06-21".
std::string written(std::chrono::year_month_day date);

/// The sun's way as a set of directions.
struct Sun {
  DirectionSet directions;       ///< weighted as was asked; add up to kWhole
  std::vector<double> hours;     ///< of sun that each direction stands for, a day on average over its days
  double worst_angle_deg = 0.0;  ///< between a place of the sun and the direction that stands for it
  std::string about;             ///< which sun it is: "sun at 47.37 N 8.54 E, 2026-06-21"

  double totalHours() const;
};

/// For legends, reports and metadata: "sun at 47.37 N 8.54 E, 2026-06-21, 15.8 h a day, 31 directions within
/// 0.5 degrees".
std::string describe(const Sun& sun);

/// How far a lattice direction may lie from the place of the sun for which it stands. Each place takes the
/// shortest vector that lies near enough, as that is the cheapest to sweep.
inline constexpr double kSunAngle = 0.5;

/// Greene's sun: a half circle from horizon to horizon through a point `tilt` degrees from the zenith (0 <=
/// tilt < 90), leaning to the compass way `toward` (0 = -z, 90 = +x, 180 = +z, 270 = -x); evenly sampled over
/// 12 hours.
struct SunArc {
  double tilt_deg = 20.0;
  double toward_deg = 180.0;
  int samples = 48;
  double within_deg = kSunAngle;
};

/// Unit direction to the sun at an hour of the day: 6 sunrise, 12 the top of the arc, 18 sunset.
Vec3 sunDirection(const SunArc& arc, double hour);
Sun makeSun(const SunArc& arc);

enum class SunWeighting {
  even,  ///< every hour counts alike
  sine   ///< times the sine of the sun's elevation: what its beam gives to level ground
};

/// The sun over a place, on one day or on every day from `first` to `last`.
struct RealSun {
  std::chrono::year_month_day first, last;
  double latitude_deg = 0.0;         ///< north is positive
  double longitude_deg = 0.0;        ///< east is positive
  double utc_offset_h = 0.0;         ///< of the local clock: 1 in Zurich's winter, -5 in New York's
  double from_h = 0.0, to_h = 24.0;  ///< by the local clock; hours without sun do not count
  double step_min = 10.0;            ///< the middle of each step stands for it
  SunWeighting weighting = SunWeighting::even;
  double north_deg = 0.0;  ///< the model's compass way of true north: 0 if it lies along -z, 90 along +x
  double within_deg = kSunAngle;
};

/// Unit direction to the sun's centre as it appears through the air (Bennett's refraction, 1010 mbar, 10 C);
/// y < 0 below the horizon. Within 0.03 degrees of NOAA's tables.
Vec3 sunDirection(const RealSun& sun, std::chrono::year_month_day date, double hour);

/// Throws InputError for settings that make no sun, among them one that is not up.
Sun makeSun(const RealSun& sun);

/// A sun that stands still, within 0.7 degrees of a unit direction; without directions where that is not
/// above the horizon.
Sun sunStandingAt(Vec3 to_sun);

/// Without air, x to the east and -z to the north: where a sun of this declination stands when it has turned
/// by the hour angle (0 at noon, 15 degrees an hour) over a latitude.
Vec3 sunAt(double latitude_deg, double declination_deg, double hour_angle_deg);

/// A whole day of such a sun, for comparison with closed forms.
Sun sunOfDeclination(double latitude_deg, double declination_deg, double step_min = 10.0,
                     double within_deg = kSunAngle);

}  // namespace espalier::sim
