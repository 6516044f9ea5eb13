#include "sim/sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "sim/error.h"
#include "sim/field.h"

namespace espalier::sim {
namespace {

constexpr int kShareSamples = 1 << 16;

/// Vectors long enough that snapping to the lattice moves a direction by much less than the way to its
/// neighbours: short ones would crowd on the planes of symmetry, which is where walls stand.
int longestForSky(int count) {
  return std::clamp(static_cast<int>(std::lround(1.4 * std::sqrt(count))), 6, 40);
}

/// Point i of n on the hemisphere, evenly spread: equal steps of height, golden-ratio steps of azimuth.
/// Single-precision sine and cosine: glibc's double versions give other last bits on other processors.
Vec3 spiralPoint(int i, int n) {
  const double height = (i + 0.5) / n;
  const double turn = i * (std::numbers::phi - 1.0);
  const auto azimuth = static_cast<float>(2.0 * std::numbers::pi * (turn - std::floor(turn)));
  const double across = std::sqrt(1.0 - height * height);
  return {across * std::cos(azimuth), height, across * std::sin(azimuth)};
}

bool before(Voxel a, Voxel b) {
  return std::tie(a.y, a.z, a.x) < std::tie(b.y, b.z, b.x);
}

/// What part of the hemisphere is nearer to each direction than to any other.
std::vector<double> shares(const std::vector<Voxel>& vectors) {
  std::vector<Vec3f> units;
  for (const Voxel v : vectors) units.push_back(Vec3f(glm::normalize(Vec3(v))));
  std::vector<double> shares(vectors.size());
  for (int s = 0; s < kShareSamples; ++s) {
    const Vec3f point(spiralPoint(s, kShareSamples));
    std::size_t nearest = 0;
    float nearest_cosine = -2.0f;
    for (std::size_t i = 0; i < units.size(); ++i) {
      const float c = glm::dot(units[i], point);
      if (c > nearest_cosine) {
        nearest_cosine = c;
        nearest = i;
      }
    }
    shares[nearest] += 1.0;
  }
  return shares;
}

}  // namespace

std::string_view nameOf(Weighting weighting) {
  switch (weighting) {
    case Weighting::uniform:
      return "uniform";
    case Weighting::cosine:
      return "cosine";
    case Weighting::cie_overcast:
      return "cie_overcast";
  }
  return "";
}

std::string_view describe(Weighting weighting) {
  switch (weighting) {
    case Weighting::uniform:
      return "uniform by solid angle";
    case Weighting::cosine:
      return "cosine-weighted view factor";
    case Weighting::cie_overcast:
      return "CIE overcast sky";
  }
  return "";
}

double received(Weighting weighting, Vec3 direction, Vec3 normal) {
  if (weighting == Weighting::uniform) return 1.0;
  const double cosine = std::max(0.0, glm::dot(direction, normal));
  return weighting == Weighting::cosine ? 2.0 * cosine : 6.0 / 7.0 * cosine * (1.0 + 2.0 * direction.y);
}

Sky makeSky(const SkySettings& settings) {
  const int count = settings.directions.value_or(256);
  if (count < 1) throw InputError(fmt::format("a sky of {} directions; expected at least 1", count));
  std::vector<Voxel> vectors;
  for (int i = 0; i < count; ++i)
    vectors.push_back(nearestLatticeVector(spiralPoint(i, count), longestForSky(count)));
  std::sort(vectors.begin(), vectors.end(), before);
  vectors.erase(std::unique(vectors.begin(), vectors.end()), vectors.end());
  return {settings.weighting, directionSet(vectors, shares(vectors), ExposureField::kWhole),
          0.3 * std::pow(count, -0.75)};
}

DirectionSet receivedBy(const Sky& sky, Vec3 normal) {
  if (sky.weighting == Weighting::uniform) return sky.directions;
  std::vector<Voxel> vectors;
  std::vector<double> amounts;
  double sum = 0.0;
  for (const LatticeDirection& d : sky.directions) {
    vectors.push_back(d.v);
    amounts.push_back(d.weight * received(sky.weighting, glm::normalize(Vec3(d.v)), normal));
    sum += amounts.back();
  }
  const int total = static_cast<int>(std::min<long>(std::lround(sum), ExposureField::kWhole));
  return directionSet(vectors, amounts, total);
}

std::string describe(const Sky& sky) {
  return fmt::format("{}, {} directions, standard error {:.1g}", describe(sky.weighting),
                     sky.directions.size(), sky.standard_error);
}

}  // namespace espalier::sim
