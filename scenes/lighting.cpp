#include "scenes/lighting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/visibility.h"
#include "sim/parallel.h"
#include "sim/sense/surface.h"
#include "sim/sweep.h"

namespace espalier::scenes {
namespace {

using render::kFaceNormals;
using sim::Vec3;
using sim::Vec3f;
using sim::Voxel;

constexpr std::uint8_t kFaces = 6;
/// A face belongs to its voxel's surface if the surface's normal leans to its side at all: the steps of a
/// gentle slope do. What is smaller is rounding.
constexpr float kLean = 1e-3f;

bool belongs(const sim::Surface& surface, std::uint8_t face) {
  return glm::dot(surface.normal, Vec3f(kFaceNormals[face])) > kLean;
}

std::shared_ptr<const sim::VoxelSet> voxelsOf(const std::vector<sim::TiledVoxel>& tiled, Voxel size) {
  sim::BitVolume bits(size);
  for (const sim::TiledVoxel& t : tiled) bits.set(t.voxel);
  return std::make_shared<const sim::VoxelSet>(std::move(bits));
}

/// Calls work(x) for the voxels of a row that have a free voxel, or the world's edge, at one of their faces.
template <typename Work>
void forEachExposed(const sim::BitVolume& occupied, int y, int z, Work work) {
  const std::uint64_t* const row = occupied.row(y, z);
  const auto word = [&](int dy, int dz, int w) {
    const int ny = y + dy, nz = z + dz;
    const bool inside = ny >= 0 && nz >= 0 && ny < occupied.size().y && nz < occupied.size().z;
    return inside ? occupied.row(ny, nz)[w] : 0;
  };
  for (int w = 0; w < occupied.rowWords() - 1; ++w) {
    const std::uint64_t enclosed = ((row[w] << 1) | (row[w - 1] >> 63)) &
                                   ((row[w] >> 1) | (row[w + 1] << 63)) & word(-1, 0, w) & word(1, 0, w) &
                                   word(0, -1, w) & word(0, 1, w);
    for (std::uint64_t left = row[w] & ~enclosed; left != 0; left &= left - 1)
      work(w * sim::BitVolume::kWordBits + std::countr_zero(left));
  }
}

/// Faces with a free voxel before them that belong to no surface.
std::vector<std::uint64_t> facesByThemselves(const sim::World& world, const Lighting& light) {
  const sim::BitVolume& occupied = world.occupied();
  std::vector<std::vector<std::uint64_t>> slices(static_cast<std::size_t>(occupied.size().y));
  sim::parallelForEach(slices.size(), [&](std::size_t slice) {
    const int y = static_cast<int>(slice);
    for (int z = 0; z < occupied.size().z; ++z) {
      forEachExposed(occupied, y, z, [&](int x) {
        const Voxel v(x, y, z);
        const sim::Surface* const surface =
            light.where->has(v) ? &light.surfaces[light.where->number(v)].surface : nullptr;
        for (std::uint8_t face = 0; face < kFaces; ++face) {
          const Voxel front = v + kFaceNormals[face];
          if (!sim::contains(occupied.size(), front) || occupied.at(front)) continue;
          if (!surface || !belongs(*surface, face)) slices[slice].push_back(light.faceKey(v, face));
        }
      });
    }
  });
  std::vector<std::uint64_t> all;
  for (const auto& slice : slices) all.insert(all.end(), slice.begin(), slice.end());
  return all;
}

Voxel voxelOfKey(std::uint64_t key, Voxel size) {
  std::uint64_t index = key / kFaces;
  const auto nx = static_cast<std::uint64_t>(size.x), nz = static_cast<std::uint64_t>(size.z);
  const int x = static_cast<int>(index % nx);
  index /= nx;
  return {x, static_cast<int>(index / nz), static_cast<int>(index % nz)};
}

/// From where a face is judged: from the voxel before it, or where a sheet lies just there, from the next.
std::optional<Voxel> placeOf(std::uint64_t face, const sim::BitVolume& opaque) {
  const Voxel normal = kFaceNormals[face % kFaces];
  Voxel place = voxelOfKey(face, opaque.size()) + normal;
  if (opaque.at(place)) place += normal;
  if (!sim::contains(opaque.size(), place) || opaque.at(place)) return std::nullopt;
  return place;
}

/// Adds receivers for faces. Places are numbered anew.
void addFaces(sim::SurfaceSensors& sensors, const std::vector<std::uint64_t>& faces,
              const sim::BitVolume& opaque) {
  if (faces.empty()) return;
  sim::BitVolume bits = sensors.places->bits();
  for (const std::uint64_t face : faces) {
    if (const auto place = placeOf(face, opaque)) bits.set(*place);
  }
  const auto places = std::make_shared<const sim::VoxelSet>(std::move(bits));
  std::vector<std::uint32_t> renumbered;
  renumbered.reserve(sensors.places->count());
  for (const Voxel v : sensors.places->voxels())
    renumbered.push_back(static_cast<std::uint32_t>(places->number(v)));
  for (auto& tap : sensors.taps) tap.place = renumbered[tap.place];
  sensors.places = places;
  for (const std::uint64_t face : faces) {
    sim::Surface surface;
    surface.normal = Vec3f(kFaceNormals[face % kFaces]);
    sensors.surfaces.push_back({voxelOfKey(face, opaque.size()), surface});
    if (const auto place = placeOf(face, opaque))
      sensors.taps.push_back({static_cast<std::uint32_t>(places->number(*place)), 1.0f});
    sensors.first.push_back(sensors.taps.size());  // without a tap it is dark
  }
}

/// What a face looking each way receives where nothing obstructs: of the half before it alone.
template <typename Amount>
std::array<float, 6> unobstructed(const sim::DirectionSet& directions, Amount amount) {
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

double share(const sim::LatticeDirection& direction) {
  return static_cast<double>(direction.weight) / sim::ExposureField::kWhole;
}

/// For each place the sum of its open directions by their brightness: the first moment of the sky in sight.
/// Directions are looked up eight at a time.
std::vector<Vec3f> moments(const sim::OpenTable& open, const sim::Sky& sky) {
  std::vector<std::array<Vec3f, 256>> sums(open.words() * 8);
  for (std::size_t eight = 0; eight < sums.size(); ++eight) {
    for (std::size_t byte = 1; byte < 256; ++byte) {
      const std::size_t rest = byte & (byte - 1);  // without its lowest bit
      const std::size_t i = 8 * eight + static_cast<std::size_t>(std::countr_zero(byte));
      sums[eight][byte] = sums[eight][rest];
      if (i >= sky.directions.size()) continue;
      const Vec3 unit = glm::normalize(Vec3(sky.directions[i].v));
      const double luminance =
          sky.weighting == sim::Weighting::cie_overcast ? (1.0 + 2.0 * unit.y) / 3.0 : 1.0;
      sums[eight][byte] += Vec3f(share(sky.directions[i]) * luminance * unit);
    }
  }
  std::vector<Vec3f> moments(open.where->count());
  sim::parallelFor(moments.size(), [&](std::size_t begin, std::size_t end) {
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

std::vector<Vec3f> brightestWays(const sim::SurfaceSensors& sensors, std::size_t surfaces,
                                 const std::vector<Vec3f>& moments) {
  std::vector<Vec3f> ways(surfaces);
  sim::parallelFor(surfaces, [&](std::size_t begin, std::size_t end) {
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
sim::DirectionSet byHours(const sim::Sun& sun) {
  std::vector<Voxel> vectors;
  for (const sim::LatticeDirection& d : sun.directions) vectors.push_back(d.v);
  return sim::directionSet(vectors, sun.hours, sim::ExposureField::kWhole);
}

bool sameWeights(const sim::DirectionSet& a, const sim::DirectionSet& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& p, const auto& q) { return p.v == q.v && p.weight == q.weight; });
}

void findInSpace(Lighting& light, const sim::World& world, const sim::Sky& sky, const sim::Sun& sun,
                 const LightWanted& wanted) {
  const auto field = [&](const sim::DirectionSet& directions) {
    return std::make_shared<const sim::ExposureField>(
        wanted.dense ? sim::sweepExposure(world.opaque(), directions)
                     : sim::sweepExposure(world.opaque(), directions, wanted.space));
  };
  light.space_sky =
      wanted.random_sky
          ? std::make_shared<const sim::ExposureField>(sim::randomExposure(
                world.opaque(), *wanted.random_sky, sky.weighting, wanted.dense ? nullptr : wanted.space))
          : field(sim::receivedBy(sky));
  light.space_sun = field(sun.directions);
  if (!wanted.space_hours) return;
  const sim::DirectionSet hours = byHours(sun);
  light.space_hours = sameWeights(hours, sun.directions) ? light.space_sun : field(hours);
}

LightAbout aboutLight(const sim::Frame& frame, const sim::Sky& sky, const sim::Sun& sun,
                      const std::optional<sim::RandomSky>& random_sky) {
  LightAbout about;
  about.weighting = sim::nameOf(sky.weighting);
  if (random_sky) {
    about.sky = sim::describe(*random_sky, sky.weighting);
    if (sky.weighting != sim::Weighting::uniform) about.sky += ", as by level ground";
    about.directions = static_cast<std::size_t>(random_sky->rays);
  } else {
    about.sky = sim::describe(sky);
    about.directions = sky.directions.size();
    about.standard_error = sky.standard_error;
  }
  if (!sun.directions.empty()) {
    about.sun = sim::describe(sun);
    about.sun_directions = sun.directions.size();
    about.sun_error_deg = sun.worst_angle_deg;
    about.sun_hours = sun.totalHours();
  }
  about.voxel_m = frame.voxel_m;
  return about;
}

/// The field at each receiver's places, by their weights.
std::vector<float> tapped(const sim::SurfaceSensors& sensors, const sim::ExposureField& field) {
  std::vector<float> values(sensors.surfaces.size());
  sim::parallelFor(values.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      float sum = 0.0f;
      for (const auto& tap : sensors.of(i))
        sum += tap.weight * static_cast<float>(field.sums[tap.place]) / sim::ExposureField::kWhole;
      values[i] = std::clamp(sum, 0.0f, 1.0f);
    }
  });
  return values;
}

void findSky(Lighting& light, const sim::World& world, const sim::Sky& sky, const LightWanted& wanted,
             const sim::SurfaceSensors& sensors, std::size_t surfaces) {
  if (wanted.random_sky) {
    light.sky.values = tapped(
        sensors, sim::randomExposure(world.opaque(), *wanted.random_sky, sky.weighting, sensors.places));
    if (!wanted.brightest) return;
  }
  const sim::OpenTable open = sim::sweepOpen(world.opaque(), sky.directions, sensors.places);
  if (!wanted.random_sky) light.sky.values = sim::surfaceSky(sensors, open, sky);
  if (wanted.brightest) light.brightest = brightestWays(sensors, surfaces, moments(open, sky));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> texts(const LightAbout& about) {
  std::vector<std::pair<std::string, std::string>> texts = {
      {"sky", about.sky}, {"weighting", about.weighting}, {"directions", std::to_string(about.directions)}};
  if (about.standard_error > 0.0)
    texts.emplace_back("standard_error", fmt::format("{:.2g}", about.standard_error));
  if (!about.sun.empty()) {
    texts.emplace_back("sun", about.sun);
    texts.emplace_back("sun_directions", std::to_string(about.sun_directions));
    texts.emplace_back("sun_error_deg", fmt::format("{:.2g}", about.sun_error_deg));
  }
  return texts;
}

std::uint64_t Lighting::faceKey(Voxel v, std::uint8_t face) const {
  const Voxel size = where->bits().size();
  const auto row =
      static_cast<std::uint64_t>(v.y) * static_cast<std::uint64_t>(size.z) + static_cast<std::uint64_t>(v.z);
  return (row * static_cast<std::uint64_t>(size.x) + static_cast<std::uint64_t>(v.x)) * kFaces + face;
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
    if (!where->has(voxelOfKey(voxel * kFaces, where->bits().size()))) means.push_back(sum / count);
  }
  return means;
}

Lighting lightOf(const sim::World& world, const sim::Sky& sky, const sim::Sun& sun,
                 const LightWanted& wanted) {
  Lighting light;
  light.about = aboutLight(world.frame(), sky, sun, wanted.random_sky);
  sim::SurfaceSensors sensors = sim::surfaceSensors(world);
  const std::size_t count = sensors.surfaces.size();
  light.where = voxelsOf(sensors.surfaces, world.frame().size);
  light.surfaces.swap(sensors.surfaces);
  if (wanted.faces) light.faces = facesByThemselves(world, light);
  sim::BitVolume gaps(world.frame().size);
  for (const std::uint64_t key : light.faces) {
    const Voxel v = voxelOfKey(key, world.frame().size);
    if (!light.where->has(v)) gaps.set(v);
  }
  light.gaps = std::make_shared<const sim::VoxelSet>(std::move(gaps));
  light.surfaces.swap(sensors.surfaces);
  addFaces(sensors, light.faces, world.opaque());
  findSky(light, world, sky, wanted, sensors, count);
  {
    const sim::OpenTable open = sim::sweepOpen(world.opaque(), sun.directions, sensors.places);
    light.sun.values = sim::surfaceSun(sensors, open, sun);
    light.sun_hours.values = sim::surfaceSunHours(sensors, open, sun);
  }
  light.surfaces = std::move(sensors.surfaces);
  light.surfaces.resize(count);
  light.sky.beyond = unobstructed(sky.directions, [&](std::size_t i, Vec3 normal) {
    const auto& d = sky.directions[i];
    return share(d) * sim::received(sky.weighting, glm::normalize(Vec3(d.v)), normal);
  });
  light.sun.beyond =
      unobstructed(sun.directions, [&](std::size_t i, Vec3) { return share(sun.directions[i]); });
  light.sun_hours.beyond = unobstructed(sun.directions, [&](std::size_t i, Vec3) { return sun.hours[i]; });
  if (wanted.dense || wanted.space) findInSpace(light, world, sky, sun, wanted);
  return light;
}

}  // namespace espalier::scenes
