#include "sim/light/random_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/random.h"
#include "sim/tile/tiling.h"

namespace espalier::sim {
namespace {

void requireRays(const RandomSky& sky) {
  if (sky.rays < 1 || sky.rays > kMostSkyDirections)
    throw InputError(fmt::format("a sky of {} random rays; expected 1 to {}", sky.rays, kMostSkyDirections));
}

/// `crossed` is room to work in.
bool reachesEdge(const BitVolume& occupied, Voxel p, Vec3 unit, std::vector<Voxel>& crossed) {
  const Vec3 size(occupied.size()), from(p);
  double leaves = size.x + size.y + size.z;
  for (int axis = 0; axis < 3; ++axis) {
    const double room = unit[axis] > 0.0 ? size[axis] - 0.5 - from[axis] : from[axis] + 0.5;
    if (unit[axis] != 0.0) leaves = std::min(leaves, room / std::abs(unit[axis]));
  }
  crossed.clear();
  tileSegment(from, from + (leaves + 1.0) * unit, crossed);
  return std::none_of(crossed.begin() + 1, crossed.end(), [&](Voxel v) { return occupied.at(v); });
}

/// Looks out without asking whether the sky makes sense.
Outlook look(const BitVolume& occupied, Voxel p, const RandomSky& sky, Weighting weighting,
             std::vector<Voxel>& crossed) {
  double whole = 0.0, open = 0.0;
  Vec3 toward(0.0);
  for (const Vec3& unit : randomDirections(sky, p)) {
    const double weight = received(weighting, unit, Vec3(0, 1, 0));
    whole += weight;
    if (!reachesEdge(occupied, p, unit, crossed)) continue;
    open += weight;
    toward += weight * unit;
  }
  const double scale = ExposureField::kWhole / whole;
  return {static_cast<std::uint16_t>(std::lround(open * scale)), scale * toward};
}

}  // namespace

std::string describe(const RandomSky& sky, Weighting weighting) {
  return fmt::format("{} random rays from each voxel, {}", sky.rays, describe(weighting));
}

double randomSkySpacing(int rays) {
  constexpr double kCovered = 0.4;
  const double half = 1.0 - kCovered / rays;  // the cosine of half the angle
  return 2.0 * half * half - 1.0;
}

std::vector<Vec3> randomDirections(const RandomSky& sky, Voxel p) {
  constexpr int kTries = 100;
  const double spacing = randomSkySpacing(sky.rays);
  const RandomKey key = keyAt(streamOf(sky.seed), p);
  std::vector<Vec3> directions;
  for (int i = 0; i < sky.rays; ++i) {
    Draws draws(key, Purpose::sky, 0, static_cast<unsigned>(i));
    Vec3 unit(0.0);
    for (int t = 0; t < kTries; ++t) {
      unit = draws.inCone(Vec3(0, 1, 0), 0.0);
      const auto near = [&](const Vec3& other) { return std::abs(glm::dot(unit, other)) > spacing; };
      if (std::none_of(directions.begin(), directions.end(), near)) break;
    }
    directions.push_back(unit);
  }
  return directions;
}

Outlook lookOut(const BitVolume& occupied, Voxel p, const RandomSky& sky, Weighting weighting) {
  requireRays(sky);
  std::vector<Voxel> crossed;
  return look(occupied, p, sky, weighting, crossed);
}

ExposureField randomExposure(const BitVolume& occupied, const RandomSky& sky, Weighting weighting,
                             std::shared_ptr<const VoxelSet> where) {
  requireRays(sky);
  const Voxel size = occupied.size();
  ExposureField field{{size, {}, where}};
  if (where) {
    const auto voxels = where->voxels();
    field.values.resize(voxels.size());
    parallelFor(voxels.size(), [&](std::size_t begin, std::size_t end) {
      std::vector<Voxel> crossed;
      for (std::size_t i = begin; i < end; ++i)
        field.values[i] = look(occupied, voxels[i], sky, weighting, crossed).sum;
    });
    return field;
  }
  field.values.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                      static_cast<std::size_t>(size.z));
  parallelForEach(static_cast<std::size_t>(size.y), [&](std::size_t y) {
    std::vector<Voxel> crossed;
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        const Voxel p(x, static_cast<int>(y), z);
        field.values[field.index(p)] = look(occupied, p, sky, weighting, crossed).sum;
      }
    }
  });
  return field;
}

}  // namespace espalier::sim
