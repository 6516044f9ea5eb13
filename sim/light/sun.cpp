#include "sim/light/sun.h"

#include <fmt/format.h>
#include <libnova/julian_day.h>
#include <libnova/precession.h>
#include <libnova/refraction.h>
#include <libnova/sidereal_time.h>
#include <libnova/solar.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <numeric>

#include "sim/base/error.h"
#include "sim/light/sun_path.h"

namespace espalier::sim {
namespace {

using std::chrono::sys_days;
using std::chrono::year_month_day;

constexpr int kMostDays = 366;

/// To a millionth of a degree: above the noise of double trigonometry, whose last bits differ between
/// processors.
double rounded(double degrees) {
  return std::round(degrees * 1e6) / 1e6;
}

/// x to the east, -z to the north; turned so that north lies along the compass way `north_deg`.
Vec3 turned(Vec3 d, double north_deg) {
  const double c = cosineOfDegrees(north_deg), s = sineOfDegrees(north_deg);
  return {c * d.x - s * d.z, d.y, s * d.x + c * d.z};
}

/// What the air makes of a direction: it lifts the sun by half a degree at the horizon.
Vec3 refracted(Vec3 d) {
  constexpr double kLowest = -1.0;  // no air lifts it above the horizon from there
  const double degrees = 180.0 / std::numbers::pi;
  const double altitude = std::asin(std::clamp(d.y, -1.0, 1.0)) * degrees;
  const double across = std::sqrt(std::max(0.0, d.x * d.x + d.z * d.z));
  if (altitude < kLowest || across < 1e-6) return d;
  // Bennett's formula tells the refraction of an apparent altitude.
  double apparent = altitude;
  for (int i = 0; i < 8; ++i) apparent = altitude + ln_get_refraction_adj(apparent, 1010.0, 10.0);
  apparent = rounded(apparent);
  const double stretch = cosineOfDegrees(apparent) / across;
  return {d.x * stretch, sineOfDegrees(apparent), d.z * stretch};
}

/// The sun's own motion over one day, by the local clock: straight between its two midnights, which is within
/// a thousandth of a degree.
class SunDay {
 public:
  SunDay(const RealSun& sun, year_month_day date) : sun_(sun) {
    constexpr double kUnixEpoch = 2'440'587.5;  // Julian days
    const auto days = static_cast<double>(sys_days(date).time_since_epoch().count());
    const double midnight = kUnixEpoch + days - sun.utc_offset_h / 24.0;
    begin_ = at(midnight);
    end_ = at(midnight + 1.0);
    end_.hour_angle = begin_.hour_angle + 360.0 + std::remainder(end_.hour_angle - begin_.hour_angle, 360.0);
  }

  Vec3 direction(double hour) const {
    const double t = hour / 24.0;
    const double declination = begin_.declination + t * (end_.declination - begin_.declination);
    const double hour_angle = begin_.hour_angle + t * (end_.hour_angle - begin_.hour_angle);
    const Vec3 d = sunAt(sun_.latitude_deg, rounded(declination), rounded(std::remainder(hour_angle, 360.0)));
    return turned(refracted(d), sun_.north_deg);
  }

 private:
  struct Position {
    double declination = 0.0, hour_angle = 0.0;  // degrees
  };

  Position at(double julian_day) const {
    // libnova remembers what it was asked last, in variables that all threads share.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    ln_equ_posn j2000{}, now{};
    ln_get_solar_equ_coords(julian_day, &j2000);  // for the equinox of 2000, whatever the date
    ln_get_equ_prec(&j2000, julian_day, &now);
    return {now.dec, 15.0 * ln_get_apparent_sidereal_time(julian_day) + sun_.longitude_deg - now.ra};
  }

  const RealSun& sun_;
  Position begin_, end_;
};

std::string whereAndWhen(const RealSun& sun) {
  std::string text = fmt::format("sun at {:g} {} {:g} {}, {}", std::abs(sun.latitude_deg),
                                 sun.latitude_deg < 0.0 ? 'S' : 'N', std::abs(sun.longitude_deg),
                                 sun.longitude_deg < 0.0 ? 'W' : 'E', written(sun.first));
  if (sun.last != sun.first) text += " to " + written(sun.last);
  if (sun.from_h > 0.0 || sun.to_h < 24.0) text += fmt::format(", {:g} to {:g} h", sun.from_h, sun.to_h);
  if (sun.weighting == SunWeighting::sine) text += ", its exposure weighted by the sine of its elevation";
  return text;
}

void requireSense(const RealSun& sun) {
  if (!sun.first.ok() || !sun.last.ok())
    throw InputError("a sun on a day that does not exist; expected a date such as 2026-06-21");
  const auto days = (sys_days(sun.last) - sys_days(sun.first)).count() + 1;
  if (days < 1) {
    throw InputError(fmt::format("a sun from {} to {}; expected the second date not to be before the first",
                                 written(sun.first), written(sun.last)));
  }
  if (days > kMostDays)
    throw InputError(fmt::format("a sun of {} days; expected at most {}: a year", days, kMostDays));
  const auto within = [](double low, double v, double high) { return v >= low && v <= high; };
  if (!within(-90.0, sun.latitude_deg, 90.0))
    throw InputError(fmt::format("a latitude of {:g} degrees; expected -90 to 90", sun.latitude_deg));
  if (!within(-180.0, sun.longitude_deg, 180.0))
    throw InputError(fmt::format("a longitude of {:g} degrees; expected -180 to 180", sun.longitude_deg));
  if (!within(-14.0, sun.utc_offset_h, 14.0))
    throw InputError(fmt::format("a clock {:g} hours from UTC; expected -14 to 14", sun.utc_offset_h));
  if (!(within(0.0, sun.from_h, 24.0) && within(0.0, sun.to_h, 24.0) && sun.from_h < sun.to_h)) {
    throw InputError(
        fmt::format("a sun from {:g} to {:g} h; expected hours from 0 to 24, the first before "
                    "the second",
                    sun.from_h, sun.to_h));
  }
  if (!within(1.0, sun.step_min, 24.0 * 60.0))
    throw InputError(fmt::format("a sun in steps of {:g} minutes; expected 1 to 1440", sun.step_min));
}

/// Calls with the middle and the length of each step, in hours.
void forEachStep(double from_h, double to_h, double step_h,
                 const std::function<void(double, double)>& visit) {
  constexpr double kNothing = 1e-9;
  for (int i = 0; from_h + i * step_h < to_h - kNothing; ++i) {
    const double begin = from_h + i * step_h, length = std::min(step_h, to_h - begin);
    visit(begin + 0.5 * length, length);
  }
}

}  // namespace

std::string written(year_month_day date) {
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

double Sun::totalHours() const {
  return std::accumulate(hours.begin(), hours.end(), 0.0);
}

std::string describe(const Sun& sun) {
  return fmt::format("{}, {:.3g} h a day, {} directions within {:.2g} degrees", sun.about, sun.totalHours(),
                     sun.directions.size(), std::ceil(sun.worst_angle_deg * 100.0) / 100.0);
}

Vec3 sunDirection(const SunArc& arc, double hour) {
  const Vec3 lean(sineOfDegrees(arc.toward_deg), 0.0, -cosineOfDegrees(arc.toward_deg));
  const Vec3 top = cosineOfDegrees(arc.tilt_deg) * Vec3(0, 1, 0) + sineOfDegrees(arc.tilt_deg) * lean;
  const Vec3 rise = glm::cross(Vec3(0, 1, 0), lean);  // east of a sun that leans south
  const double angle = 15.0 * (hour - 6.0);
  return glm::normalize(cosineOfDegrees(angle) * rise + sineOfDegrees(angle) * top);
}

Sun makeSun(const SunArc& arc) {
  if (!(arc.tilt_deg >= 0.0 && arc.tilt_deg < 90.0))
    throw InputError(
        fmt::format("a sun's arc {:g} degrees from the vertical; expected 0 to 89", arc.tilt_deg));
  if (arc.samples < 1)
    throw InputError(fmt::format("{} places of the sun; expected at least 1", arc.samples));
  SunPath path(arc.within_deg, SunWeighting::even);
  const double step_h = 12.0 / arc.samples;
  for (int i = 0; i < arc.samples; ++i) {
    path.add(step_h, [&](double moment) { return sunDirection(arc, 6.0 + (i + 0.5 + moment) * step_h); });
  }
  return path.sun(
      1, fmt::format("sun's arc {:g} degrees from the vertical towards {:g}", arc.tilt_deg, arc.toward_deg));
}

Vec3 sunDirection(const RealSun& sun, year_month_day date, double hour) {
  return SunDay(sun, date).direction(hour);
}

Sun makeSun(const RealSun& sun) {
  requireSense(sun);
  SunPath path(sun.within_deg, sun.weighting);
  int days = 0;
  for (sys_days date = sun.first; date <= sys_days(sun.last); date += std::chrono::days(1)) {
    const SunDay day(sun, date);
    ++days;
    forEachStep(sun.from_h, sun.to_h, sun.step_min / 60.0, [&](double middle, double length) {
      path.add(length, [&](double moment) { return day.direction(middle + moment * length); });
    });
  }
  if (path.empty()) {
    throw InputError(
        fmt::format("{}: the sun is never up; expected a day or hours with sun", whereAndWhen(sun)));
  }
  return path.sun(days, whereAndWhen(sun));
}

Sun sunStandingAt(Vec3 to_sun) {
  if (!(to_sun.y > 0.0)) return {};
  constexpr double kAlways = 0.7;  // beside an axis no lattice vector may lie nearer
  SunPath path(kAlways, SunWeighting::even);
  path.add(1.0, [&](double) { return to_sun; });
  return path.sun(1, "sun standing still");
}

Vec3 sunAt(double latitude_deg, double declination_deg, double hour_angle_deg) {
  const double sin_latitude = sineOfDegrees(latitude_deg), cos_latitude = cosineOfDegrees(latitude_deg);
  const double sin_declination = sineOfDegrees(declination_deg);
  const double cos_declination = cosineOfDegrees(declination_deg);
  const double toward_meridian = cos_declination * cosineOfDegrees(hour_angle_deg);
  const double north = sin_declination * cos_latitude - toward_meridian * sin_latitude;
  return glm::normalize(Vec3(-cos_declination * sineOfDegrees(hour_angle_deg),
                             sin_declination * sin_latitude + toward_meridian * cos_latitude, -north));
}

Sun sunOfDeclination(double latitude_deg, double declination_deg, double step_min, double within_deg) {
  SunPath path(within_deg, SunWeighting::even);
  forEachStep(0.0, 24.0, step_min / 60.0, [&](double middle, double length) {
    path.add(length, [&](double moment) {
      return sunAt(latitude_deg, declination_deg, 15.0 * (middle + moment * length - 12.0));
    });
  });
  return path.sun(1, fmt::format("sun of declination {:g} at latitude {:g}", declination_deg, latitude_deg));
}

}  // namespace espalier::sim
