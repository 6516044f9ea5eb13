#include "sim/light/background.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/random.h"

namespace espalier::sim {
namespace {

constexpr float kTurn = 2.0f * std::numbers::pi_v<float>;

/// Of the hemisphere by its solid angle, from places that lie evenly on it.
double meanOf(const Background& sky) {
  constexpr int kRows = 24, kColumns = 72;
  double sum = 0.0;
  for (int row = 0; row < kRows; ++row) {
    const double height = (row + 0.5) / kRows, across = std::sqrt(1.0 - height * height);
    for (int column = 0; column < kColumns; ++column) {
      const auto side = unitCircle((column + 0.5) / kColumns);
      sum += sky({across * side.x, height, across * side.y});
    }
  }
  return sum / (kRows * kColumns);
}

}  // namespace

Background backgroundOf(Weighting weighting) {
  if (weighting == Weighting::cie_overcast) return [](Vec3 unit) { return (1.0 + 2.0 * unit.y) / 3.0; };
  return [](Vec3) { return 1.0; };
}

Background gradient(double horizon) {
  return [horizon](Vec3 unit) { return horizon + (1.0 - horizon) * unit.y; };
}

Background pictured(SkyPicture picture, double turn_deg) {
  constexpr int kRows = SkyPicture::kRows, kColumns = SkyPicture::kColumns;
  if (picture.radiance.size() != std::size_t{kRows} * std::size_t{kColumns})
    throw BrokenContract("a picture of the sky of another size");
  return [picture = std::move(picture), turn_deg](Vec3 unit) {
    // In single precision, whose library gives the same on every processor.
    const float elevation = asinf(static_cast<float>(std::clamp(unit.y, -1.0, 1.0))) / kTurn * 360.0f;
    const float compass = atan2f(static_cast<float>(unit.x), static_cast<float>(-unit.z)) / kTurn * 360.0f;
    const double from_left = 180.0 + static_cast<double>(compass) - turn_deg;
    const double column = from_left - 360.0 * std::floor(from_left / 360.0);
    const auto at = [](double place, int count) {
      return static_cast<std::size_t>(std::clamp(static_cast<int>(place), 0, count - 1));
    };
    return static_cast<double>(
        picture.radiance[at(90.0 - static_cast<double>(elevation), kRows) * kColumns + at(column, kColumns)]);
  };
}

Background withBand(Background sky, const DirectionSet& sun, const SunBand& band) {
  if (band.brightness == 0.0) return sky;
  std::vector<Vec3> places;
  for (const LatticeDirection& direction : sun) places.push_back(glm::normalize(Vec3(direction.v)));
  const double rim = unitCircle(0.5 * band.width_deg / 360.0).x, most = band.brightness * meanOf(sky);
  return [sky = std::move(sky), places = std::move(places), rim, most](Vec3 unit) {
    double nearest = -1.0;
    for (const Vec3& place : places) nearest = std::max(nearest, glm::dot(place, unit));
    const double inside = std::clamp((nearest - rim) / (1.0 - rim), 0.0, 1.0);
    return sky(unit) + most * inside;
  };
}

}  // namespace espalier::sim
