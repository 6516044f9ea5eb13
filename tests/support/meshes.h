#pragma once
// Meshes with known areas and volumes.
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>

#include "sim/tile/mesh.h"

namespace espalier::tests {

using sim::Mesh;
using sim::Vec3;

/// A cube of 2 m that stands on the ground about the upright axis.
inline constexpr const char* kCubeObj =
    "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
    "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

inline Mesh emptyMesh(std::string name) {
  Mesh mesh;
  mesh.name = std::move(name);
  mesh.regions = {"all"};
  mesh.materials = {{"grey", sim::Colour(0.5f)}};
  return mesh;
}

inline void addTriangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                        std::uint32_t region = 0) {
  mesh.triangles.push_back({a, b, c});
  mesh.region.push_back(region);
  mesh.material.push_back(region);
}

/// Faces in the order -x, +x, -y, +y, -z, +z, wound outwards.
inline Mesh boxMesh(Vec3 low, Vec3 high, std::string name = "box") {
  Mesh mesh = emptyMesh(std::move(name));
  for (unsigned i = 0; i < 8; ++i) {
    mesh.vertices_m.emplace_back((i & 1u) != 0 ? high.x : low.x, (i & 2u) != 0 ? high.y : low.y,
                                 (i & 4u) != 0 ? high.z : low.z);
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& f : kFaces) {
    addTriangle(mesh, f[0], f[1], f[2]);
    addTriangle(mesh, f[0], f[2], f[3]);
  }
  return mesh;
}

/// 2 * around * (rings - 1) triangles, wound outwards.
inline Mesh sphereMesh(Vec3 centre, double radius, std::uint32_t rings, std::string name = "sphere") {
  Mesh mesh = emptyMesh(std::move(name));
  const std::uint32_t around = 2 * rings;
  mesh.vertices_m.push_back(centre + Vec3(0, radius, 0));
  for (std::uint32_t i = 1; i < rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    for (std::uint32_t j = 0; j < around; ++j) {
      const double turn = 2 * std::numbers::pi * j / around;
      mesh.vertices_m.push_back(centre + radius * Vec3(std::sin(polar) * std::cos(turn), std::cos(polar),
                                                       std::sin(polar) * std::sin(turn)));
    }
  }
  mesh.vertices_m.push_back(centre - Vec3(0, radius, 0));
  const auto bottom = static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
  const auto at = [&](std::uint32_t ring, std::uint32_t j) { return 1 + (ring - 1) * around + j % around; };
  for (std::uint32_t j = 0; j < around; ++j) {
    addTriangle(mesh, 0, at(1, j + 1), at(1, j));
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      addTriangle(mesh, at(i, j), at(i, j + 1), at(i + 1, j + 1));
      addTriangle(mesh, at(i, j), at(i + 1, j + 1), at(i + 1, j));
    }
    addTriangle(mesh, at(rings - 1, j), at(rings - 1, j + 1), bottom);
  }
  return mesh;
}

/// A height field over side x side squares of one metre.
inline Mesh terrainMesh(std::uint32_t side, double square_m,
                        const std::function<double(double, double)>& height) {
  Mesh mesh = emptyMesh("terrain");
  for (std::uint32_t i = 0; i <= side; ++i) {
    for (std::uint32_t j = 0; j <= side; ++j) {
      mesh.vertices_m.emplace_back(i * square_m, height(i * square_m, j * square_m), j * square_m);
    }
  }
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      const std::uint32_t a = i * (side + 1) + j;
      const std::uint32_t b = a + side + 1;
      addTriangle(mesh, a, a + 1, b + 1);
      addTriangle(mesh, a, b + 1, b);
    }
  }
  return mesh;
}

/// All triangles of both, with the first one's regions.
inline Mesh together(Mesh a, const Mesh& b) {
  const auto shift = static_cast<std::uint32_t>(a.vertices_m.size());
  a.vertices_m.insert(a.vertices_m.end(), b.vertices_m.begin(), b.vertices_m.end());
  for (const auto& t : b.triangles) addTriangle(a, t[0] + shift, t[1] + shift, t[2] + shift);
  return a;
}

inline Mesh insideOut(Mesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline Mesh without(Mesh mesh, const std::function<bool(Vec3 middle)>& remove) {
  Mesh kept = mesh;
  kept.triangles.clear();
  kept.region.clear();
  kept.material.clear();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const Vec3 middle = (mesh.vertices_m[t[0]] + mesh.vertices_m[t[1]] + mesh.vertices_m[t[2]]) / 3.0;
    if (!remove(middle)) addTriangle(kept, t[0], t[1], t[2], mesh.region[i]);
  }
  return kept;
}

inline double signedVolume(const Mesh& mesh) {
  double six = 0.0;
  for (const auto& t : mesh.triangles) {
    six += glm::dot(mesh.vertices_m[t[0]], glm::cross(mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]));
  }
  return six / 6.0;
}

inline double area(const Mesh& mesh) {
  double twice = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]];
    twice += glm::length(glm::cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a));
  }
  return twice / 2.0;
}

/// Vertices and triangles of an OBJ file, nothing else of it.
inline Mesh objShape(const std::string& path) {
  Mesh mesh = emptyMesh(path);
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vec3 p;
      words >> p.x >> p.y >> p.z;
      mesh.vertices_m.push_back(p);
    } else if (kind == "f") {
      std::vector<std::uint32_t> face;
      for (std::string corner; words >> corner;)
        face.push_back(static_cast<std::uint32_t>(std::stoul(corner)) - 1);
      for (std::size_t i = 2; i < face.size(); ++i) addTriangle(mesh, face[0], face[i - 1], face[i]);
    }
  }
  return mesh;
}

}  // namespace espalier::tests
