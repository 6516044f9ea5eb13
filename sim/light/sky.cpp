#include "sim/light/sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

#include "sim/base/error.h"
#include "sim/light/sky_shares.h"
#include "sim/world/field.h"

namespace espalier::sim {
namespace {

/// Point i of n on the hemisphere, evenly spread: equal steps of height, golden-ratio steps of azimuth.
/// Single-precision sine and cosine: glibc's double versions give other last bits on other processors.
Vec3 spiralPoint(int i, int n) {
  const double height = (i + 0.5) / n;
  const double turn = i * (std::numbers::phi - 1.0);
  const auto azimuth = static_cast<float>(2.0 * std::numbers::pi * (turn - std::floor(turn)));
  const double across = std::sqrt(1.0 - height * height);
  return {across * std::cos(azimuth), height, across * std::sin(azimuth)};
}

/// Vectors along points evenly spread over the sky. A longer vector lies nearer to its point, but a sweep
/// along it costs more: each takes the least of (angle in spacings)^2 + length_cost * length. With this cost
/// the error of the sky is that of the points themselves, while the vectors are two fifths shorter than those
/// that would lie nearest; shorter ones crowd on planes of simple slopes, which is where edges of walls
/// stand.
std::vector<Voxel> spreadVectors(int count) {
  const double length_cost = 0.0008 * std::min(1.0, 512.0 / count);
  const double spacing2 = 2.0 * std::numbers::pi / count;
  std::set<Voxel, decltype(&beforeInRows)> taken(beforeInRows);
  for (int i = 0; i < count; ++i) {
    const Vec3 point = spiralPoint(i, count);
    Voxel best(0);
    double least = std::numeric_limits<double>::infinity();
    forEachLatticeVector(point, 1, [&](int longest, Voxel v) {
      const double sine = sineBetween(v, point);
      const double cost = sine * sine / spacing2 + length_cost * crossedCount(v);
      if (cost < least && !taken.contains(v)) {
        least = cost;
        best = v;
      }
      return length_cost * longest < least;
    });
    taken.insert(best);
  }
  return {taken.begin(), taken.end()};
}

/// The constant of the law error = constant * directions^-0.75, the power that evenly spread points give to
/// masks with smooth edges.
double errorConstant(Weighting weighting) {
  return weighting == Weighting::uniform ? 0.48 : weighting == Weighting::cosine ? 0.52 : 0.58;
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

double unobstructed(Weighting weighting, Vec3 normal) {
  if (weighting == Weighting::uniform) return 1.0;
  const double even = 0.5 * (1.0 + normal.y);
  if (weighting == Weighting::cosine) return even;
  // P. Moon and D. Spencer, "Illumination from a Non-Uniform Sky", 1942, on a tilted plane.
  const double tilt = std::acos(std::clamp(normal.y, -1.0, 1.0));
  const double across = std::sqrt(std::max(0.0, 1.0 - normal.y * normal.y));
  return 3.0 / 7.0 * even + 4.0 / 7.0 * (across + (std::numbers::pi - tilt) * normal.y) / std::numbers::pi;
}

double skyError(Weighting weighting, int directions) {
  return errorConstant(weighting) * std::pow(directions, -0.75);
}

int directionsFor(Weighting weighting, double standard_error) {
  constexpr int kStep = 32;  // tables of directions hold a bit for each
  for (int count = kStep; count <= kMostSkyDirections; count += kStep) {
    if (skyError(weighting, count) <= standard_error) return count;
  }
  throw InputError(fmt::format(
      "a standard error of {:g} for a {} sky would need more than {} directions; expected at least {:g}",
      standard_error, nameOf(weighting), kMostSkyDirections,
      std::ceil(1e4 * skyError(weighting, kMostSkyDirections)) / 1e4));
}

Sky makeSky(const SkySettings& settings) {
  const int count =
      settings.directions ? *settings.directions : directionsFor(settings.weighting, settings.standard_error);
  if (count < 1 || count > kMostSkyDirections) {
    throw InputError(fmt::format("a sky of {} directions; expected 1 to {}", count, kMostSkyDirections));
  }
  const std::vector<Voxel> vectors = spreadVectors(count);
  std::vector<Vec3> units;
  units.reserve(vectors.size());
  for (const Voxel v : vectors) units.push_back(glm::normalize(Vec3(v)));
  std::vector<double> shares = voronoiShares(units);
  meetMoments(units, shares);
  const std::vector<std::uint16_t> weights = wholeShares(units, shares);
  Sky sky{settings.weighting, {}, skyError(settings.weighting, count)};
  for (std::size_t i = 0; i < vectors.size(); ++i)
    sky.directions.push_back({vectors[i], crossedVoxels(vectors[i]), weights[i]});
  return sky;
}

DirectionSet receivedBy(const Sky& sky, Vec3 normal) {
  if (sky.weighting == Weighting::uniform) return sky.directions;
  std::vector<Voxel> vectors;
  std::vector<double> amounts;
  for (const LatticeDirection& d : sky.directions) {
    vectors.push_back(d.v);
    amounts.push_back(d.weight * received(sky.weighting, glm::normalize(Vec3(d.v)), normal));
  }
  const double whole = unobstructed(sky.weighting, normal) * ExposureField::kWhole;
  return directionSet(vectors, amounts, static_cast<int>(std::lround(whole)));
}

std::string describe(const Sky& sky) {
  return fmt::format("{}, {} directions, standard error {:.1g}", describe(sky.weighting),
                     sky.directions.size(), sky.standard_error);
}

}  // namespace espalier::sim
