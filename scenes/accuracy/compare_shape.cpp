#include "scenes/accuracy/compare_shape.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "sim/base/parallel.h"
#include "sim/light/evened.h"
#include "sim/light/exposure.h"
#include "sim/light/surface.h"
#include "sim/sweep/sweep.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;

constexpr std::size_t kMostVoxels = 120;  // at one place: truths take their time

/// Where on the surface a voxel's value counts: the foot of its centre.
Vec3 spotOf(const sim::Frame& frame, const sim::TiledVoxel& t) {
  return sim::worldFromVoxel(frame, Vec3(t.voxel) + Vec3(t.surface.normal * t.surface.offset_vx));
}

}  // namespace

std::vector<SurfaceMap> mapsOf(const sim::World& world, const std::vector<sim::TiledVoxel>& surfaces,
                               const sim::Sky& sky, const std::vector<sim::Weighting>& weightings) {
  const sim::SurfaceSensors sensors = sim::surfaceSensors(world);
  const auto open = sim::sweepOpen(world.opaque(), sky.directions, sensors.places);
  sim::BitVolume bits(world.frame().size);
  for (const sim::TiledVoxel& t : sensors.surfaces) bits.set(t.voxel);
  const sim::VoxelSet where(std::move(bits));
  std::vector<SurfaceMap> maps;
  sim::Sky weighted = sky;
  for (const sim::Weighting weighting : weightings) {
    weighted.weighting = weighting;
    const auto values =
        sim::evened(sim::surfaceSky(sensors, open, weighted), sensors.surfaces, where, sky.standard_error);
    SurfaceMap& map = maps.emplace_back();
    for (const sim::TiledVoxel& t : surfaces) {
      if (!where.has(t.voxel)) continue;
      map.surfaces.push_back(t);
      map.values.push_back(values[where.number(t.voxel)]);
    }
  }
  return maps;
}

SurfaceMap plainMap(const sim::World& world, const std::vector<sim::TiledVoxel>& surfaces,
                    const sim::Sky& sky) {
  SurfaceMap map{surfaces, std::vector<float>(surfaces.size())};
  sim::parallelForEach(surfaces.size(), [&](std::size_t i) {
    const sim::Vec3f normal = surfaces[i].surface.normal;
    const sim::Voxel before = surfaces[i].voxel + sim::voxelAt(Vec3(normal));
    map.values[i] = static_cast<float>(
        sim::lookOut(world.occupied(), before, sim::receivedBy(sky, Vec3(normal))).fraction());
  });
  return map;
}

sim::World worldOf(const KnownShape& shape, double voxel_m, int place) {
  sim::Frame frame = sim::frameAround({shape.mesh}, voxel_m, 2.0 * voxel_m);
  frame.origin_m -= voxel_m * glm::fract(static_cast<double>(place) * Vec3(0.8191725, 0.6710436, 0.5497005));
  return sim::buildWorld(frame, {shape.mesh}, 0);
}

std::map<std::string, std::vector<sim::TiledVoxel>> byPlace(const KnownShape& shape,
                                                            const sim::World& world) {
  std::map<std::string, std::vector<sim::TiledVoxel>> places;
  for (const sim::TiledVoxel& t : world.surfaces()) {
    if (t.surface.normal == sim::Vec3f(0.0f)) continue;
    const std::string place = shape.place(spotOf(world.frame(), t), Vec3(t.surface.normal));
    if (!place.empty()) places[place].push_back(t);
  }
  for (auto& [place, voxels] : places) {
    const std::size_t step = (voxels.size() + kMostVoxels - 1) / kMostVoxels;
    for (std::size_t i = 0; i * step < voxels.size(); ++i) voxels[i] = voxels[i * step];
    voxels.resize((voxels.size() + step - 1) / step);
  }
  return places;
}

Certificate::Line errorsOf(const KnownShape& shape, const sim::World& world, sim::Weighting weighting,
                           const std::string& place, const SurfaceMap& map) {
  std::vector<double> truths(map.values.size());
  sim::parallelForEach(truths.size(), [&](std::size_t i) {
    const sim::TiledVoxel& t = map.surfaces[i];
    truths[i] = shape.truth(weighting, spotOf(world.frame(), t), Vec3(t.surface.normal));
  });
  Certificate::Line line;
  line.shape = shape.name;
  line.place = place;
  line.size_m = shape.size_m;
  line.voxels = static_cast<int>(std::lround(shape.size_m / world.frame().voxel_m));
  double squares = 0.0;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    const double error = static_cast<double>(map.values[i]) - truths[i];
    line.truth += truths[i];
    line.value += static_cast<double>(map.values[i]);
    squares += error * error;
    if (std::abs(error) > std::abs(line.worst)) line.worst = error;
  }
  const auto n = static_cast<double>(truths.size());
  line.truth /= n;
  line.value /= n;
  line.rms = std::sqrt(squares / n);
  return line;
}

std::vector<std::vector<Certificate::Line>> compareShape(const KnownShape& shape, const sim::Sky& sky,
                                                         const std::vector<sim::Weighting>& weightings,
                                                         double voxel_m, int place) {
  const sim::World world = worldOf(shape, voxel_m, place);
  std::vector<sim::TiledVoxel> all;
  for (const auto& [name, voxels] : byPlace(shape, world))
    all.insert(all.end(), voxels.begin(), voxels.end());
  const std::vector<SurfaceMap> maps = mapsOf(world, all, sky, weightings);
  std::vector<std::vector<Certificate::Line>> lines;
  for (std::size_t w = 0; w < weightings.size(); ++w) {
    std::map<std::string, SurfaceMap> parts;
    for (std::size_t i = 0; i < maps[w].values.size(); ++i) {
      const sim::TiledVoxel& t = maps[w].surfaces[i];
      SurfaceMap& part = parts[shape.place(spotOf(world.frame(), t), Vec3(t.surface.normal))];
      part.surfaces.push_back(t);
      part.values.push_back(maps[w].values[i]);
    }
    lines.emplace_back();
    for (const auto& [name, part] : parts)
      lines.back().push_back(errorsOf(shape, world, weightings[w], name, part));
  }
  return lines;
}

}  // namespace espalier::scenes
