#include "sim/directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "sim/field.h"
#include "sim/tiling.h"

namespace espalier::sim {
namespace {

constexpr int kSunLongest = 24;  // within about a degree
constexpr int kShareSamples = 1 << 16;

// Single-precision sine and cosine: glibc's double versions give other last bits on other processors.
double cosine(double radians) {
  return std::cos(static_cast<float>(radians));
}
double sine(double radians) {
  return std::sin(static_cast<float>(radians));
}

/// Vectors long enough that snapping to the lattice moves a direction by much less than the way to its
/// neighbours: short ones would crowd on the planes of symmetry, which is where walls stand.
int longestForSky(int count) {
  return std::clamp(static_cast<int>(std::lround(1.4 * std::sqrt(count))), 6, 40);
}

/// Point i of n on the hemisphere, evenly spread: equal steps of height, golden-ratio steps of azimuth.
Vec3 spiralPoint(int i, int n) {
  const double height = (i + 0.5) / n;
  const double turn = i * (std::numbers::phi - 1.0);
  const double azimuth = 2.0 * std::numbers::pi * (turn - std::floor(turn));
  const double across = std::sqrt(1.0 - height * height);
  return {across * cosine(azimuth), height, across * sine(azimuth)};
}

/// Whole-number weights in proportion to the shares, adding up to kWhole: what rounding leaves over goes to
/// the largest remainders, the first ones among equals.
std::vector<std::uint16_t> wholeWeights(const std::vector<double>& shares) {
  const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
  std::vector<std::uint16_t> weights(shares.size());
  std::vector<std::pair<double, std::size_t>> remainders;
  int left = ExposureField::kWhole;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double exact = shares[i] / total * ExposureField::kWhole;
    weights[i] = static_cast<std::uint16_t>(exact);
    left -= weights[i];
    remainders.emplace_back(weights[i] - exact, i);
  }
  std::sort(remainders.begin(), remainders.end());
  for (int k = 0; k < left; ++k)
    ++weights[remainders[static_cast<std::size_t>(k) % remainders.size()].second];
  return weights;
}

DirectionSet assemble(const std::vector<Voxel>& vectors, const std::vector<double>& shares) {
  const auto weights = wholeWeights(shares);
  DirectionSet set;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    if (weights[i] > 0) set.push_back({vectors[i], crossedVoxels(vectors[i]), weights[i]});
  }
  return set;
}

bool before(Voxel a, Voxel b) {
  return std::tie(a.y, a.z, a.x) < std::tie(b.y, b.z, b.x);
}

}  // namespace

std::vector<Voxel> crossedVoxels(Voxel v) {
  std::vector<Voxel> voxels;
  tileSegment(Vec3(0.0), Vec3(v), voxels);
  voxels.erase(voxels.begin());
  return voxels;
}

Voxel nearestLatticeVector(Vec3 unit, int longest) {
  Voxel best(0, 1, 0);
  double best_cosine = -2.0;
  const double reach = std::max({std::abs(unit.x), std::abs(unit.y), std::abs(unit.z)});
  // Among the vectors whose longest component is `scale`, the nearest one lies beside the direction's own
  // point.
  for (int scale = 1; scale <= longest; ++scale) {
    const Voxel low = Voxel(glm::floor(unit * (scale / reach)));
    for (int corner = 0; corner < 8; ++corner) {
      const Voxel raised = low + Voxel(corner & 1, (corner >> 1) & 1, corner >> 2);
      const Voxel v(raised.x, std::max(raised.y, 1), raised.z);
      if (std::max({std::abs(v.x), v.y, std::abs(v.z)}) > longest) continue;
      if (std::gcd(std::gcd(v.x, v.y), v.z) != 1) continue;
      const double c = glm::dot(Vec3(v), unit) / std::sqrt(glm::dot(Vec3(v), Vec3(v)));
      if (c > best_cosine + 1e-12) {
        best_cosine = c;
        best = v;
      }
    }
  }
  return best;
}

DirectionSet skyDirections(int count, Weighting weighting, Vec3 normal) {
  std::vector<Voxel> vectors;
  for (int i = 0; i < count; ++i)
    vectors.push_back(nearestLatticeVector(spiralPoint(i, count), longestForSky(count)));
  std::sort(vectors.begin(), vectors.end(), before);
  vectors.erase(std::unique(vectors.begin(), vectors.end()), vectors.end());

  std::vector<Vec3f> units;
  for (const Voxel v : vectors) units.push_back(Vec3f(glm::normalize(Vec3(v))));
  std::vector<double> shares(vectors.size());
  for (int s = 0; s < kShareSamples; ++s) {
    const Vec3 point = spiralPoint(s, kShareSamples);
    const double amount = weighting == Weighting::uniform ? 1.0 : std::max(0.0, glm::dot(point, normal));
    if (amount == 0.0) continue;
    std::size_t nearest = 0;
    float nearest_cosine = -2.0f;
    for (std::size_t i = 0; i < units.size(); ++i) {
      const float c = glm::dot(units[i], Vec3f(point));
      if (c > nearest_cosine) {
        nearest_cosine = c;
        nearest = i;
      }
    }
    shares[nearest] += amount;
  }
  return assemble(vectors, shares);
}

Vec3 sunDirection(const SunArc& arc, double hour) {
  const double radians = std::numbers::pi / 180.0;
  const Vec3 lean(sine(arc.toward_deg * radians), 0.0, -cosine(arc.toward_deg * radians));
  const Vec3 top = cosine(arc.tilt_deg * radians) * Vec3(0, 1, 0) + sine(arc.tilt_deg * radians) * lean;
  const Vec3 rise = glm::cross(Vec3(0, 1, 0), lean);  // east of a sun that leans south
  const double angle = (hour - 6.0) / 12.0 * std::numbers::pi;
  return glm::normalize(cosine(angle) * rise + sine(angle) * top);
}

DirectionSet sunDirections(const SunArc& arc) {
  std::vector<Voxel> vectors;
  for (int i = 0; i < arc.samples; ++i) {
    vectors.push_back(
        nearestLatticeVector(sunDirection(arc, 6.0 + 12.0 * (i + 0.5) / arc.samples), kSunLongest));
  }
  std::sort(vectors.begin(), vectors.end(), before);
  std::vector<Voxel> distinct;
  std::vector<double> shares;
  for (const Voxel v : vectors) {
    if (distinct.empty() || distinct.back() != v) {
      distinct.push_back(v);
      shares.push_back(0.0);
    }
    shares.back() += 1.0;
  }
  return assemble(distinct, shares);
}

DirectionSet singleDirection(Vec3 unit) {
  return assemble({nearestLatticeVector(unit, kSunLongest)}, {1.0});
}

}  // namespace espalier::sim
