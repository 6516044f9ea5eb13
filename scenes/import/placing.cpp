#include "scenes/import/placing.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace espalier::scenes {
namespace {

/// Sine and cosine that are exact for quarter turns and the same on every machine: of the double functions in
/// glibc only the square root is. The float sine's error turns the mesh by less than 1e-7.
std::pair<double, double> sineAndCosine(double degrees) {
  const double quarters = std::nearbyint(degrees / 90.0);
  const auto rest_deg = static_cast<float>(degrees - 90.0 * quarters);
  const double s = std::sin(rest_deg * (glm::pi<float>() / 180.0f));
  const double c = std::sqrt(1.0 - s * s);
  switch (static_cast<int>(std::fmod(quarters, 4.0) + 4.0) % 4) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

/// glm's matrices are written column by column.
glm::dmat3 turnAbout(int axis, double degrees) {
  const auto [s, c] = sineAndCosine(degrees);
  if (axis == 0) return {{1, 0, 0}, {0, c, s}, {0, -s, c}};
  if (axis == 1) return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
  return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}

glm::dmat3 turnBy(const sim::Vec3& rotate_deg) {
  return turnAbout(2, rotate_deg.z) * turnAbout(1, rotate_deg.y) * turnAbout(0, rotate_deg.x);
}

/// A unit in metres, as a fraction.
std::pair<double, double> metresOf(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::m:
      break;
    case LengthUnit::cm:
      return {1.0, 100.0};
    case LengthUnit::mm:
      return {1.0, 1000.0};
    case LengthUnit::in:
      return {254.0, 10'000.0};
    case LengthUnit::ft:
      return {3048.0, 10'000.0};
  }
  return {1.0, 1.0};
}

}  // namespace

Placing::Placing(const Placement& placement)
    : scale_(placement.scale), turn_(turnBy(placement.rotate_deg)), translate_m_(placement.translate_m) {
  std::tie(numerator_, denominator_) = metresOf(placement.unit.value_or(LengthUnit::m));
  if (placement.up == UpAxis::z) turn_ = turn_ * turnAbout(0, -90.0);
}

sim::Vec3 Placing::point(const sim::Vec3& of_file) const {
  return turn_ * (inMetres(of_file) * scale_) + translate_m_;
}

}  // namespace espalier::scenes
