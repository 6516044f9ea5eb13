#include "scenes/import/facing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "render/finish/ray_scene.h"
#include "sim/base/parallel.h"
#include "sim/base/random.h"
#include "sim/light/sky.h"
#include "sim/tile/joined.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;
using sim::Vec3f;

constexpr int kFewestPoints = 4, kMostPoints = 64, kAllPoints = 20'000;  // of a patch, and of all
constexpr std::size_t kMostPatches = 50'000;  // are judged, the largest: more are a cloud of leaves
constexpr int kDirections = 32;
constexpr double kDark = 0.02, kLit = 0.05;  // of what an open sky gives level ground
constexpr double kTimes = 10.0;              // as much light on the other side

Vec3 crossOf(const sim::Mesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return glm::cross(mesh.vertices_m[b] - mesh.vertices_m[a], mesh.vertices_m[c] - mesh.vertices_m[a]);
}

/// Which triangles are wound against the larger part of what they hang together with, and how large that is.
struct Patches : sim::WoundPatches {
  std::vector<double> areas;
};

Patches patchesOf(const sim::Mesh& mesh) {
  Patches patches{sim::woundPatches(sim::joined(mesh)), {}};
  for (const std::vector<std::uint32_t>& patch : patches.triangles) {
    double area = 0.0, against = 0.0;
    for (const std::uint32_t t : patch) {
      const double size = glm::length(crossOf(mesh, t));
      area += size;
      if (patches.against[t]) against += size;
    }
    if (2.0 * against > area) {
      for (const std::uint32_t t : patch) patches.against[t] = !patches.against[t];
    }
    patches.areas.push_back(area);
  }
  return patches;
}

/// The numbers of those that are judged.
std::vector<std::size_t> largestOf(const Patches& patches) {
  std::vector<std::size_t> largest(patches.areas.size());
  std::iota(largest.begin(), largest.end(), std::size_t{0});
  if (largest.size() <= kMostPatches) return largest;
  std::stable_sort(largest.begin(), largest.end(),
                   [&](std::size_t a, std::size_t b) { return patches.areas[a] > patches.areas[b]; });
  largest.resize(kMostPatches);
  return largest;
}

/// What comes to the two sides of a patch's triangles, of an open sky's light on level ground.
struct BothSides {
  double front = 0.0, back = 0.0;
};

/// `step_m`: so far before a triangle light is looked for.
BothSides lightOn(const sim::Mesh& mesh, const std::vector<std::uint32_t>& patch,
                  const std::vector<bool>& against, const render::RayScene& scene,
                  const std::vector<Vec3>& sky, int points, double step_m) {
  std::vector<double> ends;
  double area = 0.0;
  for (const std::uint32_t t : patch) ends.push_back(area += glm::length(crossOf(mesh, t)));
  BothSides sum;
  if (!(area > 0.0)) return sum;
  for (int i = 0; i < points; ++i) {
    const auto found = std::upper_bound(ends.begin(), ends.end(), (i + 0.5) / points * area);
    const std::uint32_t t = patch[std::min(static_cast<std::size_t>(found - ends.begin()), ends.size() - 1)];
    // Evenly over the triangle, and turned from point to point, by golden ratios (Roberts 2018).
    double u = std::fmod(0.5 + 0.7548776662466927 * i, 1.0), v = std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const auto turn = sim::unitCircle(std::fmod(i * std::numbers::phi, 1.0));
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 at = mesh.vertices_m[a] * (1.0 - u - v) + mesh.vertices_m[b] * u + mesh.vertices_m[c] * v;
    const Vec3 normal = glm::normalize(crossOf(mesh, t)) * (against[t] ? -1.0 : 1.0);
    for (std::size_t first = 0; first < sky.size(); first += render::kRays) {
      render::RayScene::ShadowRays rays;
      std::array<double, render::kRays> before{};
      for (std::size_t k = 0; k < std::min<std::size_t>(render::kRays, sky.size() - first); ++k) {
        const Vec3& d = sky[first + k];
        const Vec3 way(d.x * turn.x - d.z * turn.y, d.y, d.x * turn.y + d.z * turn.x);
        before[k] = glm::dot(way, normal);
        rays.origins_m[k] = Vec3f(at + normal * (before[k] > 0.0 ? step_m : -step_m));
        rays.directions[k] = Vec3f(way);
        rays.wanted[k] = before[k] != 0.0;
      }
      const auto clear = scene.clear(rays);
      for (std::size_t k = 0; k < render::kRays; ++k) {
        if (clear[k]) (before[k] > 0.0 ? sum.front : sum.back) += std::abs(before[k]);
      }
    }
  }
  // Even over the hemisphere, the mean cosine with its pole is one half.
  const double all = 0.5 * points * static_cast<double>(sky.size());
  return {sum.front / all, sum.back / all};
}

bool facesAway(const BothSides& light) {
  return light.front < kDark && light.back > kLit && light.back > kTimes * light.front;
}

}  // namespace

std::vector<FacingReport> findFacing(std::vector<sim::TiledMesh>& meshes) {
  std::vector<FacingReport> reports;
  if (std::none_of(meshes.begin(), meshes.end(), [](const sim::TiledMesh& m) { return m.where_closed; }))
    return reports;
  render::ModelScene model;
  Vec3 low(INFINITY), high(-INFINITY);
  for (const sim::TiledMesh& tiled : meshes) {
    if (tiled.lit()) model.meshes.push_back(&tiled.mesh);
    for (const Vec3& p : tiled.mesh.vertices_m) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  const double step_m = 2e-5 * glm::length(high - low);
  const render::RayScene scene(model);
  std::vector<Vec3> sky;
  for (const sim::LatticeDirection& d : sim::makeSky({.directions = kDirections}).directions)
    sky.push_back(glm::normalize(Vec3(d.v)));
  for (sim::TiledMesh& tiled : meshes) {
    if (!tiled.where_closed) continue;
    const sim::Mesh& mesh = tiled.mesh;
    Patches patches = patchesOf(mesh);
    const std::vector<std::size_t> judged = largestOf(patches);
    const int points =
        std::clamp(kAllPoints / static_cast<int>(judged.size() + 1), kFewestPoints, kMostPoints);
    std::vector<std::uint8_t> away(patches.triangles.size());
    sim::parallelFor(judged.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        away[judged[i]] = facesAway(
            lightOn(mesh, patches.triangles[judged[i]], patches.against, scene, sky, points, step_m));
      }
    });
    FacingReport report{mesh.name};
    double area = 0.0;
    for (std::size_t i = 0; i < away.size(); ++i) {
      for (const std::uint32_t t : patches.triangles[i]) {
        if (away[i] != 0) patches.against[t] = !patches.against[t];
        const double size = glm::length(crossOf(mesh, t));
        area += size;
        if (!patches.against[t]) continue;
        ++report.turned;
        report.area_share += size;
      }
    }
    if (report.turned == 0) continue;
    report.area_share /= area > 0.0 ? area : 1.0;
    tiled.turned = std::move(patches.against);
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace espalier::scenes
