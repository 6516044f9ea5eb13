#include "sim/light/lighting.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "sim/base/faces.h"
#include "sim/base/memory.h"
#include "sim/base/parallel.h"
#include "sim/light/evened.h"
#include "sim/light/lit_faces.h"
#include "sim/light/sky_shares.h"
#include "sim/light/surface.h"
#include "sim/sweep/sweep.h"

namespace espalier::sim {
namespace {

std::shared_ptr<const VoxelSet> voxelsOf(const std::vector<TiledVoxel>& tiled, Voxel size) {
  BitVolume bits(size);
  for (const TiledVoxel& t : tiled) bits.set(t.voxel);
  return std::make_shared<const VoxelSet>(std::move(bits));
}

/// What a face looking each way receives where nothing obstructs: of the half before it alone.
template <typename Amount>
std::array<float, 6> unobstructed(const DirectionSet& directions, Amount amount) {
  std::array<float, 6> sums{};
  for (std::uint8_t face = 0; face < kFaces; ++face) {
    const Vec3 normal(kFaceNormals[face]);
    double sum = 0.0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double ahead = glm::dot(Vec3(directions[i].v), normal);
      if (ahead >= 0.0) sum += (ahead > 0.0 ? 1.0 : 0.5) * amount(i, normal);
    }
    sums[face] = static_cast<float>(sum);
  }
  return sums;
}

/// For each place the sum of its open directions by their brightness: the first moment of the sky in sight.
/// Directions are looked up eight at a time.
std::vector<Vec3f> moments(const OpenTable& open, const Sky& sky) {
  std::vector<std::array<Vec3f, 256>> sums(open.words() * 8);
  for (std::size_t eight = 0; eight < sums.size(); ++eight) {
    for (std::size_t byte = 1; byte < 256; ++byte) {
      const std::size_t rest = byte & (byte - 1);  // without its lowest bit
      const std::size_t i = 8 * eight + static_cast<std::size_t>(std::countr_zero(byte));
      sums[eight][byte] = sums[eight][rest];
      if (i >= sky.directions.size()) continue;
      const Vec3 unit = glm::normalize(Vec3(sky.directions[i].v));
      const double luminance = sky.weighting == Weighting::cie_overcast ? (1.0 + 2.0 * unit.y) / 3.0 : 1.0;
      sums[eight][byte] += Vec3f(shareOf(sky.directions[i]) * luminance * unit);
    }
  }
  std::vector<Vec3f> moments(open.where->count());
  parallelFor(moments.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t place = begin; place < end; ++place) {
      const auto row = open.row(place);
      Vec3f sum(0.0f);
      for (std::size_t eight = 0; eight < sums.size(); ++eight)
        sum += sums[eight][(row[eight / 8] >> (8 * (eight % 8))) & 0xffu];
      moments[place] = sum;
    }
  });
  return moments;
}

std::vector<Vec3f> brightestWays(const SurfaceSensors& sensors, std::size_t surfaces,
                                 const std::vector<Vec3f>& moments) {
  std::vector<Vec3f> ways(surfaces);
  parallelFor(surfaces, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Vec3f sum(0.0f);
      for (const auto& tap : sensors.of(i)) sum += tap.weight * moments[tap.place];
      const float length = glm::length(sum);
      ways[i] = length > 1e-6f ? sum / length : Vec3f(0.0f);
    }
  });
  return ways;
}

/// The sun's directions weighted by their hours.
DirectionSet byHours(const Sun& sun) {
  std::vector<Voxel> vectors;
  for (const LatticeDirection& d : sun.directions) vectors.push_back(d.v);
  return directionSet(vectors, sun.hours, ExposureField::kWhole);
}

bool sameWeights(const DirectionSet& a, const DirectionSet& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& p, const auto& q) { return p.v == q.v && p.weight == q.weight; });
}

void findInSpace(Lighting& light, const World& world, const Sky& sky, const Sun& sun,
                 const LightWanted& wanted) {
  const auto where = wanted.dense ? nullptr : wanted.space;
  const auto field = [&](const BitVolume& opaque, const DirectionSet& directions) {
    return std::make_shared<const ExposureField>(where ? sweepExposure(opaque, directions, where)
                                                       : sweepExposure(opaque, directions));
  };
  const auto skyField = [&](const BitVolume& opaque) {
    if (!wanted.random_sky) return field(opaque, receivedBy(sky));
    return std::make_shared<const ExposureField>(
        randomExposure(opaque, *wanted.random_sky, sky.weighting, where));
  };
  light.space_sky = skyField(world.opaque());
  if (wanted.bare) {
    BitVolume bare = world.opaque();
    bare.keep(*wanted.bare);
    light.bare_sky = skyField(bare);
  }
  light.space_sun = field(world.opaque(), sun.directions);
  if (!wanted.space_hours) return;
  const DirectionSet hours = byHours(sun);
  light.space_hours = sameWeights(hours, sun.directions) ? light.space_sun : field(world.opaque(), hours);
}

LightAbout aboutLight(const Frame& frame, const Sky& sky, const Sun& sun,
                      const std::optional<RandomSky>& random_sky) {
  LightAbout about;
  about.weighting = nameOf(sky.weighting);
  if (random_sky) {
    about.sky = describe(*random_sky, sky.weighting);
    if (sky.weighting != Weighting::uniform) about.sky += ", as by level ground";
    about.directions = static_cast<std::size_t>(random_sky->rays);
  } else {
    about.sky = describe(sky);
    about.directions = sky.directions.size();
    about.standard_error = sky.standard_error;
  }
  if (!sun.directions.empty()) {
    about.sun = describe(sun);
    about.sun_directions = sun.directions.size();
    about.sun_error_deg = sun.worst_angle_deg;
    about.sun_hours = sun.totalHours();
  }
  about.voxel_m = frame.voxel_m;
  return about;
}

/// The field at each receiver's places, by their weights.
std::vector<float> tapped(const SurfaceSensors& sensors, const ExposureField& field) {
  std::vector<float> values(sensors.surfaces.size());
  parallelFor(values.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      float sum = 0.0f;
      for (const auto& tap : sensors.of(i))
        sum += tap.weight * static_cast<float>(field.values[tap.place]) / ExposureField::kWhole;
      values[i] = std::clamp(sum, 0.0f, 1.0f);
    }
  });
  return values;
}

void findSky(Lighting& light, const World& world, const Sky& sky, const LightWanted& wanted,
             const SurfaceSensors& sensors, std::size_t surfaces) {
  if (wanted.random_sky) {
    light.sky.values =
        tapped(sensors, randomExposure(world.opaque(), *wanted.random_sky, sky.weighting, sensors.places));
    if (!wanted.brightest) return;
  }
  const OpenTable open = sweepOpen(world.opaque(), sky.directions, sensors.places);
  if (!wanted.random_sky) {
    light.sky.values = surfaceSky(sensors, open, sky);
    const std::span all(light.sky.values);
    std::ranges::copy(evened(all.first(surfaces), std::span(sensors.surfaces).first(surfaces), *light.where,
                             sky.standard_error),
                      all.begin());
  }
  if (wanted.brightest) light.brightest = brightestWays(sensors, surfaces, moments(open, sky));
}

}  // namespace

std::uint64_t Lighting::faceKey(Voxel v, std::uint8_t face) const {
  const Voxel size = where->bits().size();
  const auto row =
      static_cast<std::uint64_t>(v.y) * static_cast<std::uint64_t>(size.z) + static_cast<std::uint64_t>(v.z);
  return (row * static_cast<std::uint64_t>(size.x) + static_cast<std::uint64_t>(v.x)) * kFaces + face;
}

Voxel Lighting::voxelOf(std::uint64_t face_key) const {
  return voxelOfKey(face_key, where->bits().size());
}

float Lighting::atFace(const Received& light, Voxel voxel, std::uint8_t face) const {
  if (where->has(voxel)) {
    const std::size_t number = where->number(voxel);
    if (belongs(surfaces[number].surface, face)) return light.values[number];
  }
  const std::uint64_t wanted = faceKey(voxel, face);
  const auto at = std::lower_bound(faces.begin(), faces.end(), wanted);
  if (at == faces.end() || *at != wanted) return light.beyond[face];
  return light.values[surfaces.size() + static_cast<std::size_t>(at - faces.begin())];
}

std::vector<float> Lighting::ofGaps(const Received& light) const {
  std::vector<float> means;
  means.reserve(gaps->count());
  for (std::size_t i = 0; i < faces.size();) {
    const std::uint64_t voxel = faces[i] / kFaces;
    float sum = 0.0f, count = 0.0f;
    for (; i < faces.size() && faces[i] / kFaces == voxel; ++i) {
      sum += light.values[surfaces.size() + i];
      count += 1.0f;
    }
    if (!where->has(voxelOf(voxel * kFaces))) means.push_back(sum / count);
  }
  return means;
}

Lighting lightOf(const World& world, const Sky& sky, const Sun& sun, const LightWanted& wanted) {
  Lighting light;
  light.about = aboutLight(world.frame(), sky, sun, wanted.random_sky);
  SurfaceSensors sensors = surfaceSensors(world);
  const std::size_t count = sensors.surfaces.size();
  light.where = voxelsOf(sensors.surfaces, world.frame().size);
  light.surfaces.swap(sensors.surfaces);
  if (wanted.faces) light.faces = facesByThemselves(world, light);
  BitVolume gaps(world.frame().size);
  for (const std::uint64_t key : light.faces) {
    const Voxel v = voxelOfKey(key, world.frame().size);
    if (!light.where->has(v)) gaps.set(v);
  }
  light.gaps = std::make_shared<const VoxelSet>(std::move(gaps));
  light.surfaces.swap(sensors.surfaces);
  addFaces(sensors, light.faces, world.opaque());
  releaseFreed();  // what was needed to find them, in small pieces
  findSky(light, world, sky, wanted, sensors, count);
  {
    const OpenTable open = sweepOpen(world.opaque(), sun.directions, sensors.places);
    SunOnSurfaces both = sunOnSurfaces(sensors, open, sun);
    light.sun.values = std::move(both.shares);
    light.sun_hours.values = std::move(both.hours);
  }
  std::optional<Sun> now;
  if (wanted.to_sun) {
    now = sunStandingAt(*wanted.to_sun);
    light.sun_now.values =
        surfaceSun(sensors, sweepOpen(world.opaque(), now->directions, sensors.places), *now);
  }
  light.surfaces = std::move(sensors.surfaces);
  light.surfaces.resize(count);
  light.sky.beyond = unobstructed(sky.directions, [&](std::size_t i, Vec3 normal) {
    const auto& d = sky.directions[i];
    return shareOf(d) * received(sky.weighting, glm::normalize(Vec3(d.v)), normal);
  });
  const auto shares = [](const DirectionSet& directions) {
    return unobstructed(directions, [&](std::size_t i, Vec3) { return shareOf(directions[i]); });
  };
  light.sun.beyond = shares(sun.directions);
  if (now) light.sun_now.beyond = shares(now->directions);
  light.sun_hours.beyond = unobstructed(sun.directions, [&](std::size_t i, Vec3) { return sun.hours[i]; });
  if (wanted.dense || wanted.space) findInSpace(light, world, sky, sun, wanted);
  return light;
}

}  // namespace espalier::sim
