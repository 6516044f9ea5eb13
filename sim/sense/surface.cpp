#include "sim/sense/surface.h"

#include <algorithm>
#include <functional>

#include "sim/field.h"

namespace espalier::sim {
namespace {

constexpr int kReach = 1;  // voxels around a surface that may be looked at

/// Calls add(neighbour, weight) for the free voxels in front of a surface: the more squarely, the more
/// weight.
void forEachInFront(const BitVolume& blocked, Voxel surface, Vec3f normal,
                    const std::function<void(Voxel, float)>& add) {
  for (int dy = -kReach; dy <= kReach; ++dy) {
    for (int dz = -kReach; dz <= kReach; ++dz) {
      for (int dx = -kReach; dx <= kReach; ++dx) {
        const Vec3f step(static_cast<float>(dx), static_cast<float>(dy), static_cast<float>(dz));
        const float ahead = glm::dot(step, normal);
        const Voxel neighbour = surface + Voxel(dx, dy, dz);
        if (ahead <= 0.0f || !contains(blocked.size(), neighbour) || blocked.at(neighbour)) continue;
        add(neighbour, ahead * ahead / glm::dot(step, step));
      }
    }
  }
}

/// Sums over a surface's taps of the amounts that its open directions give.
std::vector<float> gathered(const SurfaceSensors& sensors, const OpenTable& open,
                            const DirectionSet& directions,
                            const std::function<double(std::size_t direction, Vec3 normal)>& amount) {
  std::vector<float> values(sensors.surfaces.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Vec3 normal(sensors.surfaces[i].surface.normal);
    double sum = 0.0;
    for (const auto& tap : sensors.of(i)) {
      for (std::size_t d = 0; d < directions.size(); ++d) {
        if (open.open(tap.place, d)) sum += static_cast<double>(tap.weight) * amount(d, normal);
      }
    }
    values[i] = static_cast<float>(std::clamp(sum, 0.0, 1.0));
  }
  return values;
}

std::vector<Vec3> units(const DirectionSet& directions) {
  std::vector<Vec3> units;
  for (const LatticeDirection& d : directions) units.push_back(glm::normalize(Vec3(d.v)));
  return units;
}

double share(const LatticeDirection& d) {
  return static_cast<double>(d.weight) / ExposureField::kWhole;
}

}  // namespace

SurfaceSensors surfaceSensors(const World& world) {
  SurfaceSensors sensors;
  BitVolume places(world.frame().size);
  for (const TiledVoxel& tiled : world.surfaces()) {
    bool any = false;
    forEachInFront(world.occupied(), tiled.voxel, tiled.surface.normal, [&](Voxel v, float) {
      places.set(v);
      any = true;
    });
    if (any) sensors.surfaces.push_back(tiled);
  }
  sensors.places = std::make_shared<const VoxelSet>(std::move(places));
  for (const TiledVoxel& tiled : sensors.surfaces) {
    sensors.first.push_back(sensors.taps.size());
    float sum = 0.0f;
    forEachInFront(world.occupied(), tiled.voxel, tiled.surface.normal, [&](Voxel v, float weight) {
      sensors.taps.push_back({static_cast<std::uint32_t>(sensors.places->number(v)), weight});
      sum += weight;
    });
    for (std::size_t i = sensors.first.back(); i < sensors.taps.size(); ++i) sensors.taps[i].weight /= sum;
  }
  sensors.first.push_back(sensors.taps.size());
  return sensors;
}

std::vector<float> surfaceSky(const SurfaceSensors& sensors, const OpenTable& open, const Sky& sky) {
  const auto to = units(sky.directions);
  return gathered(sensors, open, sky.directions, [&](std::size_t d, Vec3 normal) {
    return share(sky.directions[d]) * received(sky.weighting, to[d], normal);
  });
}

std::vector<float> surfaceSun(const SurfaceSensors& sensors, const OpenTable& open, const Sun& sun) {
  const auto to = units(sun.directions);
  return gathered(sensors, open, sun.directions, [&](std::size_t d, Vec3 normal) {
    return glm::dot(to[d], normal) >= 0.0 ? share(sun.directions[d]) : 0.0;
  });
}

std::vector<float> surfaceSunHours(const SurfaceSensors& sensors, const OpenTable& open, const Sun& sun) {
  const auto to = units(sun.directions);
  auto hours = gathered(sensors, open, sun.directions, [&](std::size_t d, Vec3 normal) {
    return glm::dot(to[d], normal) >= 0.0 ? sun.hours[d] / sun.totalHours() : 0.0;
  });
  for (float& h : hours) h *= static_cast<float>(sun.totalHours());
  return hours;
}

}  // namespace espalier::sim
