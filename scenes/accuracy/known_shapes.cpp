#include "scenes/accuracy/known_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/light/surface.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;
constexpr double kPi = std::numbers::pi;

/// Over the elevations from `hidden` to the zenith, of what one azimuth gives to a level receiver.
double levelStrip(sim::Weighting weighting, double hidden) {
  const double s = std::sin(hidden);
  switch (weighting) {
    case sim::Weighting::uniform:
      return (1.0 - s) / (2.0 * kPi);
    case sim::Weighting::cosine:
      return (1.0 - s * s) / (2.0 * kPi);
    case sim::Weighting::cie_overcast:
      return ((1.0 - s * s) / 2.0 + 2.0 / 3.0 * (1.0 - s * s * s)) / (7.0 * kPi / 3.0);
  }
  return 0.0;
}

/// The same to an upright receiver that faces `aside` of the azimuth's own way.
double uprightStrip(sim::Weighting weighting, double hidden, double aside) {
  const double facing = std::cos(aside), s = std::sin(hidden), c = std::cos(hidden);
  if (facing <= 0.0) return 0.0;
  const double cosines = facing * (kPi / 2.0 - hidden - s * c) / 2.0;
  switch (weighting) {
    case sim::Weighting::uniform:
      return (1.0 - s) / (2.0 * kPi);
    case sim::Weighting::cosine:
      return cosines / kPi;
    case sim::Weighting::cie_overcast:
      return (cosines + facing * 2.0 / 3.0 * c * c * c) / (7.0 * kPi / 3.0);
  }
  return 0.0;
}

/// Grows a mesh of boxes and prisms in one colour.
struct Builder {
  sim::Mesh mesh;

  explicit Builder(std::string name) {
    mesh.name = std::move(name);
    mesh.regions = {"all"};
    mesh.materials = {{"grey", sim::Colour(0.5f)}};
  }
  /// A prism over a convex or ring-like floor plan is added quad by quad, wound outwards.
  void quad(const std::array<Vec3, 4>& q) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    mesh.vertices_m.insert(mesh.vertices_m.end(), q.begin(), q.end());
    for (const auto& t : {std::array{0u, 1u, 2u}, std::array{0u, 2u, 3u}}) {
      mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      mesh.region.push_back(0);
      mesh.material.push_back(0);
    }
  }
  void box(Vec3 low, Vec3 high, const std::function<Vec3(Vec3)>& turned) {
    const auto corner = [&](int x, int y, int z) {
      return turned(Vec3(x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z));
    };
    quad({corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)});
    quad({corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)});
    quad({corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)});
    quad({corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0)});
    quad({corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0)});
    quad({corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)});
  }
};

std::function<Vec3(Vec3)> turn(double degrees) {
  const double s = std::sin(degrees * kPi / 180.0), c = std::cos(degrees * kPi / 180.0);
  return [s, c](Vec3 p) { return Vec3(c * p.x - s * p.z, p.y, s * p.x + c * p.z); };
}

const auto kUnturned = [](Vec3 p) { return p; };
constexpr double kThick = 3.0;  // of walls and floors, in voxels
constexpr double kSame = 1e-3;  // how far a normal may be off: at edges it belongs to two faces

bool looksUp(Vec3 normal) {
  return normal.y > 1.0 - kSame;
}

/// How far the middle of a floor reaches.
double middle(double half, double voxel_m) {
  return std::max(0.05 * half, voxel_m);
}

/// Elevation of the top of a wall that runs across the way azimuth 0, `at` ahead of a point (or behind it)
/// and `height` above it. A wall does not hide anything from a point on itself.
double overWall(double at, double height, double azimuth) {
  const double across = std::cos(azimuth) * at;
  return across > 1e-7 * height && height > 0.0 ? std::atan(height * std::cos(azimuth) / at) : 0.0;
}

}  // namespace

double skySeen(sim::Weighting weighting, const Skyline& skyline, Vec3 normal) {
  constexpr int kSteps = 720;
  const bool level = looksUp(normal);
  const double faces = std::atan2(normal.z, normal.x);
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double azimuth = 2.0 * kPi * (i + 0.5) / kSteps;
    const double hidden = skyline(azimuth);
    sum += level ? levelStrip(weighting, hidden) : uprightStrip(weighting, hidden, azimuth - faces);
  }
  return sum * 2.0 * kPi / kSteps;
}

KnownShape street(double width_m, double height_m, double turn_deg, double voxel_m) {
  Builder builder("street");
  const double half = width_m / 2.0, thick = kThick * voxel_m, end = 30.0 * std::max(width_m, height_m);
  const auto turned = turn(turn_deg), back = turn(-turn_deg);
  builder.box({-half - thick, -thick, -end}, {half + thick, 0.0, end}, turned);
  builder.box({-half - thick, -thick, -end}, {-half, height_m, end}, turned);
  builder.box({half, -thick, -end}, {half + thick, height_m, end}, turned);
  const auto place = [=](Vec3 p, Vec3 n) -> std::string {
    const Vec3 q = back(p), m = back(n);
    if (std::abs(q.z) > 3.0 * voxel_m) return "";
    if (looksUp(n) && std::abs(q.x) < half - voxel_m / 2.0 && p.y < height_m / 2.0)
      return std::abs(q.x) < middle(half, voxel_m) ? kMiddleOfTheFloor : kFloor;
    const bool inwards = std::abs(std::abs(m.x) - 1.0) < kSame && m.x * q.x < 0.0;
    return inwards && p.y > voxel_m / 2.0 && p.y < height_m - voxel_m / 2.0 ? kWalls : "";
  };
  const auto truth = [=](sim::Weighting weighting, Vec3 p, Vec3 n) {
    const double x = back(p).x, turn_rad = turn_deg * kPi / 180.0;
    return skySeen(
        weighting,
        [&](double azimuth) {
          return std::max(overWall(half - x, height_m - p.y, azimuth - turn_rad),
                          overWall(-half - x, height_m - p.y, azimuth - turn_rad));
        },
        n);
  };
  return {"endless street", {std::move(builder.mesh), true}, width_m, place, truth};
}

KnownShape court(double width_m, double height_m, double turn_deg, double voxel_m) {
  Builder builder("court");
  const double half = width_m / 2.0, out = half + kThick * voxel_m;
  const auto turned = turn(turn_deg);
  const auto back = turn(-turn_deg);
  builder.box({-out, -kThick * voxel_m, -out}, {out, 0.0, out}, turned);
  builder.box({-out, -kThick * voxel_m, -out}, {-half, height_m, out}, turned);
  builder.box({half, -kThick * voxel_m, -out}, {out, height_m, out}, turned);
  builder.box({-out, -kThick * voxel_m, -out}, {out, height_m, -half}, turned);
  builder.box({-out, -kThick * voxel_m, half}, {out, height_m, out}, turned);
  const auto place = [=](Vec3 p, Vec3 n) -> std::string {
    const Vec3 q = back(p), m = back(n);
    const double rim = voxel_m / 2.0, across = std::max(std::abs(q.x), std::abs(q.z));
    if (looksUp(n) && across < half - rim && p.y < height_m / 2.0)
      return across < middle(half, voxel_m) ? kMiddleOfTheFloor : kFloor;
    for (const int axis : {0, 2}) {
      const bool inwards = std::abs(std::abs(m[axis]) - 1.0) < kSame && m[axis] * q[axis] < 0.0;
      if (inwards && std::abs(q[2 - axis]) < half - rim && p.y > rim && p.y < height_m - rim) return kWalls;
    }
    return "";
  };
  const auto truth = [=](sim::Weighting weighting, Vec3 p, Vec3 n) {
    const Vec3 q = back(p);
    const double turn_rad = turn_deg * kPi / 180.0;
    return skySeen(
        weighting,
        [&](double azimuth) {
          const double a = azimuth - turn_rad;
          double hidden = 0.0;
          for (const double side : {-half, half}) {
            hidden = std::max(hidden, overWall(side - q.x, height_m - p.y, a));
            hidden = std::max(hidden, overWall(side - q.z, height_m - p.y, a - kPi / 2.0));
          }
          return hidden;
        },
        n);
  };
  return {turn_deg == 0.0 ? "square court" : fmt::format("square court turned by {:g} degrees", turn_deg),
          {std::move(builder.mesh), true},
          width_m,
          place,
          truth};
}

KnownShape pit(double diameter_m, double depth_m, double voxel_m) {
  Builder builder("pit");
  const double r = diameter_m / 2.0, outer = r + kThick * voxel_m, floor = -kThick * voxel_m;
  builder.box({-outer, floor, -outer}, {outer, 0.0, outer}, kUnturned);
  constexpr int kSides = 256;
  // The polygon has the circle's area.
  const double inner = r * std::sqrt(2.0 * kPi / kSides / std::sin(2.0 * kPi / kSides));
  const auto at = [&](double radius, double y, int i) {
    const double a = 2.0 * kPi * i / kSides;
    return Vec3(radius * std::cos(a), y, radius * std::sin(a));
  };
  for (int i = 0; i < kSides; ++i) {
    builder.quad(
        {at(inner, floor, i), at(inner, floor, i + 1), at(inner, depth_m, i + 1), at(inner, depth_m, i)});
    builder.quad(
        {at(outer, floor, i), at(outer, depth_m, i), at(outer, depth_m, i + 1), at(outer, floor, i + 1)});
    builder.quad(
        {at(inner, depth_m, i), at(inner, depth_m, i + 1), at(outer, depth_m, i + 1), at(outer, depth_m, i)});
    builder.quad(
        {at(inner, floor, i), at(outer, floor, i), at(outer, floor, i + 1), at(inner, floor, i + 1)});
  }
  const auto place = [=](Vec3 p, Vec3 n) -> std::string {
    const double out = std::hypot(p.x, p.z);
    if (!looksUp(n) || p.y > depth_m / 2.0 || out > r - voxel_m) return "";
    return out < middle(r, voxel_m) ? kMiddleOfTheFloor : kFloor;
  };
  const auto truth = [=](sim::Weighting weighting, Vec3 p, Vec3 n) {
    return skySeen(
        weighting,
        [&](double azimuth) {
          const double along = -(p.x * std::cos(azimuth) + p.z * std::sin(azimuth));
          const double square = along * along + r * r - p.x * p.x - p.z * p.z;
          return std::atan((depth_m - p.y) / (along + std::sqrt(std::max(0.0, square))));
        },
        n);
  };
  return {"round pit", {std::move(builder.mesh), true}, diameter_m, place, truth};
}

KnownShape canopy(double width_m, double height_m, double voxel_m) {
  Builder builder("canopy");
  const double half = width_m / 2.0, thick = kThick * voxel_m;
  builder.box({-width_m, -thick, -width_m}, {width_m, 0.0, width_m}, kUnturned);
  builder.box({-half, height_m, -half}, {half, height_m + thick, half}, kUnturned);
  const auto place = [=](Vec3 p, Vec3 n) -> std::string {
    const double out = std::max(std::abs(p.x), std::abs(p.z));
    if (!looksUp(n) || p.y > height_m / 2.0 || out > half - voxel_m / 2.0) return "";
    return out < middle(half, voxel_m) ? kMiddleOfTheFloor : kFloor;
  };
  const auto truth = [=](sim::Weighting weighting, Vec3 p, Vec3 n) {
    // What lies above the roof's edges is hidden, and no more.
    const double above = skySeen(
        weighting,
        [&](double azimuth) {
          const double c = std::cos(azimuth), s = std::sin(azimuth);
          const double to_x = ((c > 0.0 ? half : -half) - p.x) / c,
                       to_z = ((s > 0.0 ? half : -half) - p.z) / s;
          return std::atan((height_m - p.y) / std::min(to_x, to_z));
        },
        n);
    return 1.0 - above;
  };
  return {"ground under a square roof", {std::move(builder.mesh), true}, width_m, place, truth};
}

KnownShape slope(double tilt_deg, double toward_deg, double size_m) {
  Builder builder("slope");
  const double half = size_m / 2.0, tilt = tilt_deg * kPi / 180.0;
  const auto turned = turn(toward_deg);
  const Vec3 normal = turned(Vec3(std::sin(tilt), std::cos(tilt), 0.0));
  builder.box({-half, -half, -half}, {half, 0.0, half}, [&](Vec3 p) {
    return turned(
        Vec3(std::cos(tilt) * p.x + std::sin(tilt) * p.y, -std::sin(tilt) * p.x + std::cos(tilt) * p.y, p.z));
  });
  return {fmt::format("open plane tilted by {:g} degrees", tilt_deg),
          {std::move(builder.mesh), true},
          0.0,
          [=](Vec3 p, Vec3 n) -> std::string {
            const bool inner = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < half / 2.0;
            return inner && glm::dot(n, normal) > 1.0 - kSame ? kAll : "";
          },
          [](sim::Weighting weighting, Vec3, Vec3 n) { return sim::openSky(weighting, n); }};
}

}  // namespace espalier::scenes
