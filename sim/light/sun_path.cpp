#include "sim/light/sun_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>

#include "sim/base/error.h"
#include "sim/world/field.h"

namespace espalier::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

/// The vector of least cost whose angle to a unit vector has at most this sine.
std::optional<Voxel> cheapest(Vec3 unit, int lowest, double sine) {
  std::optional<Voxel> best;
  forEachLatticeVector(unit, lowest, [&](int longest, Voxel v) {
    if (sineBetween(v, unit) <= sine && (!best || crossedCount(v) < crossedCount(*best))) best = v;
    return !best || longest < crossedCount(*best);
  });
  return best;
}

/// Level vectors are for a sun that only they are near enough to, or nearly on the horizon itself: any kerb
/// blocks them for ever.
std::optional<Voxel> snapped(Vec3 unit, double sine) {
  if (unit.y > 0.5 * sine) {
    if (const auto v = cheapest(unit, 1, sine)) return v;
  }
  return cheapest(unit, 0, sine);
}

double leastSine(Vec3 unit) {
  double least = 1.0;
  forEachLatticeVector(unit, 0, [&](int, Voxel v) {
    least = std::min(least, sineBetween(v, unit));
    return true;
  });
  return least;
}

double degreesOf(double sine) {
  return std::asin(std::min(1.0, sine)) / kRadians;
}

}  // namespace

double cosineOfDegrees(double degrees) {
  return std::cos(static_cast<float>(degrees * kRadians));
}

double sineOfDegrees(double degrees) {
  return std::sin(static_cast<float>(degrees * kRadians));
}

SunPath::SunPath(double within_deg, SunWeighting weighting)
    : within_sine_(sineOfDegrees(within_deg)), weighting_(weighting) {
  if (!(within_deg > 0.0 && within_deg <= 10.0))
    throw InputError(fmt::format("the sun's directions within {:g} degrees; expected more than 0, at most 10",
                                 within_deg));
}

void SunPath::add(double hours, const std::function<Vec3(double)>& at) {
  constexpr std::array kMoments{0.0, 0.125, -0.125, 0.25, -0.25, 0.375, -0.375};
  const Vec3 middle = at(0.0);
  if (middle.y <= 0.0) return;
  for (const double moment : kMoments) {
    const Vec3 unit = at(moment);
    const auto v = unit.y > 0.0 ? snapped(unit, within_sine_) : std::nullopt;
    if (!v) continue;
    worst_sine_ = std::max(worst_sine_, sineBetween(*v, unit));
    places_.push_back({*v, hours, hours * (weighting_ == SunWeighting::even ? 1.0 : middle.y)});
    return;
  }
  double needed = 1.0;
  for (const double moment : kMoments) {
    const Vec3 unit = at(moment);
    if (unit.y > 0.0) needed = std::min(needed, leastSine(unit));
  }
  if (!missed_) missed_ = Missed{degreesOf(middle.y), needed};
  missed_->needed_sine = std::max(missed_->needed_sine, needed);
}

Sun SunPath::sun(int days, std::string about) const {
  if (missed_) {
    throw InputError(fmt::format(
        "no direction lies within {:g} degrees of the sun {:.1f} degrees above the horizon; expected at "
        "least {:.2f}",
        degreesOf(within_sine_), missed_->altitude_deg,
        std::ceil(degreesOf(missed_->needed_sine) * 100.0 + 1e-6) / 100.0));
  }
  auto places = places_;
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return beforeInRows(a.v, b.v); });
  Sun sun;
  sun.about = std::move(about);
  sun.worst_angle_deg = degreesOf(worst_sine_);
  std::vector<Voxel> vectors;
  std::vector<double> weights;
  for (const Place& place : places) {
    if (vectors.empty() || vectors.back() != place.v) {
      vectors.push_back(place.v);
      weights.push_back(0.0);
      sun.hours.push_back(0.0);
    }
    weights.back() += place.weight;
    sun.hours.back() += place.hours / days;
  }
  sun.directions = directionSet(vectors, weights, ExposureField::kWhole);
  return sun;
}

}  // namespace espalier::sim
