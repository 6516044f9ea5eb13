#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "scenes/problem.h"
#include "sim/base/vec.h"
#include "sim/light/background.h"
#include "sim/light/sky.h"
#include "sim/light/sun.h"

/// What a scene says of its light.
namespace espalier::scenes {

/// Where the sky is looked for: along the same lattice directions from everywhere, or along Greene's random
/// rays from each place.
enum class Sampling { lattice, random };

/// What the sky is behind what a plant sees of it that turns to the light.
struct BackgroundSpec {
  enum class Kind { weighting, uniform, cie_overcast, gradient, picture };

  Kind kind = Kind::weighting;  ///< weighting: what the sky's own means
  double horizon = 0.3;         ///< of a gradient: brightness there, over that of the zenith
  std::filesystem::path file;   ///< of a picture
  std::string told;             ///< what reports call it
  double turn_deg = 0.0;        ///< the compass way of the picture's middle: 0 = -z, 90 = +x
  sim::SunBand sun;
  Place file_place = {};  ///< where a scene file names the picture; without a path where none does
};

struct SkySpec {
  static constexpr double kMapError = 0.003, kGrowthError = 0.005;

  sim::Weighting weighting = sim::Weighting::uniform;
  /// Standard error of sky_exposure; without it kMapError where light alone is asked for, and kGrowthError
  /// where plants grow, which ask for light again and again.
  std::optional<double> accuracy;
  std::optional<int> directions;  ///< instead
  Sampling sampling = Sampling::lattice;
  int rays = 100;  ///< from each place, of random sampling
  BackgroundSpec background;
  // Of images of vines: times that of a clear morning.
  double brightness = 1.0;
  sim::Colour tint{1.0f};  ///< linear RGB
};

/// Where on earth a real sun shines. (Not inside SunSpec: an optional of a struct that the struct around it
/// still has to finish cannot be made by clang.)
struct SunPlace {
  double latitude_deg = 0.0, longitude_deg = 0.0;  ///< north and east are positive
  double utc_offset_h = 0.0;                       ///< of the local clock
};

/// The sun: an inclined arc, or with a place the real one.
struct SunSpec {
  struct Dates {
    std::chrono::year_month_day from, to;  ///< both included
  };
  struct Hours {
    double from = 0.0, to = 24.0;  ///< by the local clock
  };

  // Greene's arc: a half circle from horizon to horizon through a point `tilt` from the zenith.
  double tilt_deg = 20.0;
  double toward_deg = 180.0;  ///< the compass way to which it leans: 0 = -z (north), 90 = +x (east), 180 = +z
  int samples = 48;

  // The real sun.
  std::optional<SunPlace> place;
  std::optional<std::chrono::year_month_day> date;  ///< either this
  std::optional<Dates> dates;                       ///< or these
  Hours hours;
  double step_min = 10.0;
  sim::SunWeighting weighting = sim::SunWeighting::even;
  double north_deg = 0.0;  ///< the model's compass way of true north

  // Either.
  double accuracy_deg = sim::kSunAngle;  ///< of its directions
  double brightness = 1.0;               ///< in images of vines, times that of a clear morning
  double shadow_hour = 15.0;  ///< time of day of the shadow matte; on the arc 6 is sunrise and 18 sunset

  std::chrono::year_month_day firstDay() const {
    return date ? *date : dates ? dates->from : std::chrono::year_month_day{};
  }
};

/// Where exposure maps are wanted beside the surfaces.
enum class ExposureWhere { surfaces, band, everything };

/// What tables of exposure make of surfaces from which no sky and no sun is seen, such as those inside of
/// closed rooms.
enum class Unreached { count, leave_out };

/// How directions count for light that bounces.
enum class BounceWeighting { lambert, equal };

/// Light that bounces, in pictures.
struct InterreflectionSpec {
  int passes = 8;            ///< at most, the first included
  double tolerance = 0.002;  ///< as sim::BounceSettings has it
  int directions = 128;      ///< over each half of the sphere
  BounceWeighting weighting = BounceWeighting::lambert;
};

struct ExposureSpec {
  ExposureWhere where = ExposureWhere::surfaces;
  int band_vx = 4;  ///< of ExposureWhere::band: free voxels up to so many from a surface
  Unreached unreached = Unreached::count;
  Place place = {};  ///< where a scene file has it; without a path where none does
};

}  // namespace espalier::scenes
