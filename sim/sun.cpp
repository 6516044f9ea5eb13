#include "sim/sun.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "sim/field.h"

namespace espalier::sim {
namespace {

constexpr int kLongest = 24;  // within about a degree

// Single-precision sine and cosine: glibc's double versions give other last bits on other processors.
double cosine(double radians) {
  return std::cos(static_cast<float>(radians));
}
double sine(double radians) {
  return std::sin(static_cast<float>(radians));
}

bool before(Voxel a, Voxel b) {
  return std::tie(a.y, a.z, a.x) < std::tie(b.y, b.z, b.x);
}

}  // namespace

double Sun::totalHours() const {
  return std::accumulate(hours.begin(), hours.end(), 0.0);
}

Vec3 sunDirection(const SunArc& arc, double hour) {
  const double radians = std::numbers::pi / 180.0;
  const Vec3 lean(sine(arc.toward_deg * radians), 0.0, -cosine(arc.toward_deg * radians));
  const Vec3 top = cosine(arc.tilt_deg * radians) * Vec3(0, 1, 0) + sine(arc.tilt_deg * radians) * lean;
  const Vec3 rise = glm::cross(Vec3(0, 1, 0), lean);  // east of a sun that leans south
  const double angle = (hour - 6.0) / 12.0 * std::numbers::pi;
  return glm::normalize(cosine(angle) * rise + sine(angle) * top);
}

Sun makeSun(const SunArc& arc) {
  std::vector<Voxel> vectors;
  for (int i = 0; i < arc.samples; ++i) {
    vectors.push_back(
        nearestLatticeVector(sunDirection(arc, 6.0 + 12.0 * (i + 0.5) / arc.samples), kLongest));
  }
  std::sort(vectors.begin(), vectors.end(), before);
  std::vector<Voxel> distinct;
  Sun sun;
  sun.about = fmt::format("inclined arc, {:.4g} degrees from the zenith towards {:.4g}", arc.tilt_deg,
                          arc.toward_deg);
  for (const Voxel v : vectors) {
    if (distinct.empty() || distinct.back() != v) {
      distinct.push_back(v);
      sun.hours.push_back(0.0);
    }
    sun.hours.back() += 12.0 / arc.samples;
  }
  sun.directions = directionSet(distinct, sun.hours, ExposureField::kWhole);
  return sun;
}

std::string describe(const Sun& sun) {
  return fmt::format("{}, {:.3g} h a day, {} directions within {:.2g} degrees", sun.about, sun.totalHours(),
                     sun.directions.size(), sun.worst_angle_deg);
}

}  // namespace espalier::sim
