#include "scenes/accuracy/spot_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "render/files/gltf.h"
#include "render/finish/ray_scene.h"
#include "sim/base/parallel.h"
#include "sim/base/random.h"
#include "sim/light/light.h"
#include "sim/light/open_rays.h"
#include "sim/light/surface.h"
#include "sim/sweep/sweep.h"
#include "sim/tile/tiling.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;
using sim::Vec3f;
using sim::Voxel;

constexpr int kPoints = 3000;
constexpr int kRays = 4096;        // spread over the hemisphere of the sky
constexpr std::size_t kSplit = 6;  // of every so many points the error is split, by so many more directions
constexpr std::size_t kTimesDirections = 4;

struct Point {
  Vec3 p_m;
  Vec3 normal;  ///< of its triangle, to the side that it faces; of a solid's, outwards
  std::size_t mesh, triangle;
  Voxel voxel;
};

/// Points of the triangles that lie within the world, and not inside of it: stones reach into walls.
std::vector<Point> drawPoints(const Site& site, std::uint64_t seed) {
  std::vector<double> ends;  // of each triangle's share of the area
  std::vector<std::pair<std::size_t, std::size_t>> triangles;
  double area = 0.0;
  for (std::size_t m = 0; m < site.meshes.size(); ++m) {
    if (!site.meshes[m].lit()) continue;
    const sim::Mesh& mesh = site.meshes[m].mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const Vec3 u = mesh.vertices_m[b] - mesh.vertices_m[a], v = mesh.vertices_m[c] - mesh.vertices_m[a];
      area += glm::length(glm::cross(u, v));
      ends.push_back(area);
      triangles.emplace_back(m, t);
    }
  }
  std::vector<Point> points;
  if (!(area > 0.0)) return points;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    sim::Draws draws({sim::streamOf(seed), i}, sim::Purpose::spot);
    const auto found = std::upper_bound(ends.begin(), ends.end(), draws.uniform(0.0, area));
    const auto [m, t] = triangles[std::min(static_cast<std::size_t>(found - ends.begin()), ends.size() - 1)];
    const sim::Mesh& mesh = site.meshes[m].mesh;
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 u = mesh.vertices_m[b] - mesh.vertices_m[a], v = mesh.vertices_m[c] - mesh.vertices_m[a];
    double s = draws.uniform(), r = draws.uniform();
    if (s + r > 1.0) {
      s = 1.0 - s;
      r = 1.0 - r;
    }
    const Vec3 p = mesh.vertices_m[a] + s * u + r * v;
    const Vec3 q = sim::voxelFromWorld(site.world.frame(), p);
    const Voxel nearest = sim::voxelAt(q);
    if (!sim::contains(site.world.frame().size, nearest) || !(glm::length(glm::cross(u, v)) > 0.0)) continue;
    const sim::TiledMesh& tiled = site.meshes[m];
    Vec3 normal = glm::normalize(glm::cross(u, v)) * (!tiled.turned.empty() && tiled.turned[t] ? -1.0 : 1.0);
    const auto solid = [&](const Vec3& way) { return site.world.opaque().at(sim::voxelAt(q + way)); };
    const bool may_be_closed = tiled.solid || tiled.where_closed;
    if (may_be_closed && solid(normal) && !solid(-normal)) normal = -normal;
    if (!solid(normal)) points.push_back({p, normal, m, t, sim::tilePoint(q)});
  }
  return points;
}

/// Evenly spread over the hemisphere y > 0: equal steps of height, golden-ratio steps of azimuth.
std::vector<Vec3> hemisphere() {
  std::vector<Vec3> directions;
  for (int i = 0; i < kRays; ++i) {
    const double y = (i + 0.5) / kRays, across = std::sqrt(1.0 - y * y);
    const auto azimuth = static_cast<float>(2.0 * std::numbers::pi * std::fmod(i * std::numbers::phi, 1.0));
    directions.emplace_back(across * std::cos(azimuth), y, across * std::sin(azimuth));
  }
  return directions;
}

/// How far a ray runs until it leaves the world: beyond its edge nothing hides the sky.
float reach(const sim::Frame& frame, Vec3 p_m, Vec3 direction) {
  const Vec3 p = sim::voxelFromWorld(frame, p_m);
  double nearest = 1e30;
  for (int axis = 0; axis < 3; ++axis) {
    const double edge = direction[axis] > 0.0 ? frame.size[axis] - 0.5 : -0.5;
    if (direction[axis] != 0.0) nearest = std::min(nearest, (edge - p[axis]) / direction[axis]);
  }
  return static_cast<float>(std::max(0.0, nearest) * frame.voxel_m);
}

Vec3f start(const Site& site, const Point& point) {
  return Vec3f(point.p_m + 1e-3 * site.world.frame().voxel_m * point.normal);
}

/// Whether something stands before the point, nearer than a voxel: a joint between things.
bool inJoint(const Site& site, const render::RayScene& scene, const Point& point) {
  render::RayScene::ShadowRays rays;
  rays.origins_m[0] = start(site, point);
  rays.directions[0] = Vec3f(point.normal);
  rays.reach_m[0] = static_cast<float>(site.world.frame().voxel_m);
  rays.wanted[0] = true;
  return !scene.clear(rays)[0];
}

/// What the point receives by the rays, as sim::surfaceSky has it.
double traced(const Site& site, const render::RayScene& scene, const std::vector<Vec3>& directions,
              const Point& point) {
  double received = 0.0, most = 0.0;
  for (std::size_t first = 0; first < directions.size(); first += render::kRays) {
    render::RayScene::ShadowRays rays;
    std::array<double, render::kRays> amount{};
    for (std::size_t k = 0; k < render::kRays; ++k) {
      const Vec3& d = directions[first + k];
      if (!(glm::dot(d, point.normal) > 0.0)) continue;
      amount[k] = sim::received(site.sky.weighting, d, point.normal);
      most += amount[k];
      rays.origins_m[k] = start(site, point);
      rays.directions[k] = Vec3f(d);
      rays.reach_m[k] = reach(site.world.frame(), point.p_m, d);
      rays.wanted[k] = true;
    }
    const auto clear = scene.clear(rays);
    for (std::size_t k = 0; k < render::kRays; ++k) received += clear[k] ? amount[k] : 0.0;
  }
  return most > 0.0 ? received / most * sim::openSky(site.sky.weighting, point.normal) : 0.0;
}

struct Mapped {
  double value;
  Vec3f normal;
};

/// Which directions are open: by rays where that is less work than a sweep of the world.
sim::OpenTable openAt(const sim::BitVolume& opaque, const sim::DirectionSet& directions,
                      const std::shared_ptr<const sim::VoxelSet>& places) {
  const std::vector<Voxel> voxels = places->voxels();
  if (sim::sweepIsCheaper(opaque.size(), voxels.size())) return sim::sweepOpen(opaque, directions, places);
  sim::ClearAhead ahead;
  return {places, directions.size(), sim::OpenRays(opaque, directions).from(opaque, voxels, ahead)};
}

/// A map's values at the points' voxels, where it has any.
using MappedVoxels = std::map<Voxel, Mapped, decltype(&sim::beforeInRows)>;

MappedVoxels mapAt(const sim::Lighting& light, const std::vector<Point>& points) {
  MappedVoxels values(sim::beforeInRows);
  for (const Point& point : points) {
    if (!light.where->has(point.voxel)) continue;
    const std::size_t number = light.where->number(point.voxel);
    values[point.voxel] = {static_cast<double>(light.sky.values[number]),
                           light.surfaces[number].surface.normal};
  }
  return values;
}

/// By another sky.
MappedVoxels mapAt(const Site& site, const sim::Sky& sky, const std::vector<Point>& points) {
  std::set<Voxel, decltype(&sim::beforeInRows)> voxels(sim::beforeInRows);
  for (const Point& point : points) voxels.insert(point.voxel);
  std::vector<sim::TiledVoxel> tiled;
  for (const Voxel voxel : voxels) {
    if (const auto surface = site.world.surfaceAt(voxel)) tiled.push_back({voxel, *surface});
  }
  const auto sensors = sim::surfaceSensors(site.world, std::move(tiled));
  const auto open = openAt(site.world.opaque(), sky.directions, sensors.places);
  const auto received = sim::surfaceSky(sensors, open, sky);
  MappedVoxels values(sim::beforeInRows);
  for (std::size_t i = 0; i < received.size(); ++i) {
    values[sensors.surfaces[i].voxel] = {static_cast<double>(received[i]),
                                         sensors.surfaces[i].surface.normal};
  }
  return values;
}

/// 0 where the map has none.
double valueIn(const MappedVoxels& map, const Point& point) {
  const auto found = map.find(point.voxel);
  return found == map.end() ? 0.0 : found->second.value;
}

/// What directions and voxels make of the error of some points.
void split(const Site& site, const MappedVoxels& map, const std::vector<Point>& points,
           const std::vector<double>& truths, Certificate::SpotCheck& check) {
  const std::size_t wanted =
      std::min<std::size_t>(kTimesDirections * site.sky.directions.size(), sim::kMostSkyDirections);
  const sim::Sky fine =
      sim::makeSky({.weighting = site.sky.weighting, .directions = static_cast<int>(wanted)});
  const MappedVoxels finer = mapAt(site, fine, points);
  double of_directions = 0.0, of_voxels = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double value = valueIn(map, points[i]), better = valueIn(finer, points[i]);
    of_directions += std::abs(value - better);
    of_voxels += std::abs(better - truths[i]);
  }
  const auto n = static_cast<double>(std::max<std::size_t>(1, points.size()));
  check.size_of_directions = of_directions / n;
  check.size_of_voxels = of_voxels / n;
}

/// Whether the point's voxel is its own: one that holds several faces has one value and one normal.
bool onFace(const Site& site, const render::RayScene& scene, const MappedVoxels& map, const Point& point) {
  constexpr double kSameFace = 0.7;
  const auto found = map.find(point.voxel);
  return found != map.end() && glm::dot(point.normal, Vec3(found->second.normal)) >= kSameFace &&
         !inJoint(site, scene, point);
}

}  // namespace

std::optional<Certificate::SpotCheck> spotCheck(const Site& site, const sim::Lighting& light,
                                                std::uint64_t seed) {
  render::ModelScene model;
  for (const sim::TiledMesh& tiled : site.meshes) {
    if (tiled.lit() && tiled.shade) model.meshes.push_back(&tiled.mesh);
  }
  const render::RayScene scene(model);
  const std::vector<Point> points = drawPoints(site, seed);
  if (points.empty()) return std::nullopt;
  const MappedVoxels map = mapAt(light, points);
  Certificate::SpotCheck check;
  check.rays = kRays;
  check.points = points.size();
  check.left_out = kPoints - points.size();

  const auto directions = hemisphere();
  std::vector<double> truths(points.size());
  sim::parallelForEach(points.size(),
                       [&](std::size_t i) { truths[i] = traced(site, scene, directions, points[i]); });

  std::vector<double> sizes;
  double squares = 0.0, squares_on_faces = 0.0;
  std::vector<Point> some;  // of those on faces
  std::vector<double> truths_of_some;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double value = valueIn(map, points[i]), error = value - truths[i];
    check.bias += error;
    squares += error * error;
    if (onFace(site, scene, map, points[i])) {
      squares_on_faces += error * error;
      check.size_on_faces += std::abs(error);
      if (check.on_faces++ % kSplit == 0) {
        some.push_back(points[i]);
        truths_of_some.push_back(truths[i]);
      }
    }
    if (sizes.empty() || std::abs(error) > std::abs(check.worst.value - check.worst.truth)) {
      const sim::Mesh& mesh = site.meshes[points[i].mesh].mesh;
      check.worst = {points[i].p_m, mesh.name, mesh.regions[mesh.region[points[i].triangle]], truths[i],
                     value};
    }
    sizes.push_back(std::abs(error));
  }
  const auto n = static_cast<double>(points.size());
  check.bias /= n;
  check.rms = std::sqrt(squares / n);
  const auto faces = static_cast<double>(std::max<std::size_t>(1, check.on_faces));
  check.rms_on_faces = std::sqrt(squares_on_faces / faces);
  check.size_on_faces /= faces;
  split(site, map, some, truths_of_some, check);
  std::sort(sizes.begin(), sizes.end());
  check.median = sizes[sizes.size() / 2];
  check.percentile_95 = sizes[sizes.size() * 95 / 100];
  return check;
}

}  // namespace espalier::scenes
