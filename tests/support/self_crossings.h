#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "render/model/box_pairs.h"
#include "render/model/model_mesh.h"

/// Where surfaces run through themselves, asked of every triangle.
namespace espalier::tests {

using Points = std::array<sim::Vec3, 3>;
using Numbers = std::array<std::uint32_t, 3>;

/// Six times the volume of a tetrahedron: which side of abc d lies on.
inline double side(sim::Vec3 a, sim::Vec3 b, sim::Vec3 c, sim::Vec3 d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

inline bool goesThrough(sim::Vec3 p, sim::Vec3 q, const Points& t) {
  const double a = side(t[0], t[1], t[2], p), b = side(t[0], t[1], t[2], q);
  if (!((a > 0 && b < 0) || (a < 0 && b > 0))) return false;
  const double u = side(p, q, t[0], t[1]), v = side(p, q, t[1], t[2]), w = side(p, q, t[2], t[0]);
  return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

/// The triangles of a mesh.
class Triangles {
 public:
  explicit Triangles(const render::ModelMesh& mesh) : mesh_(mesh) {}

  std::vector<render::Box> boxes() const {
    std::vector<render::Box> boxes;
    for (const auto& t : mesh_.triangles) {
      render::Box box{mesh_.positions_m[t[0]], mesh_.positions_m[t[0]]};
      for (const std::uint32_t corner : t) {
        box.low = glm::min(box.low, mesh_.positions_m[corner]);
        box.high = glm::max(box.high, mesh_.positions_m[corner]);
      }
      boxes.push_back(box);
    }
    return boxes;
  }
  std::uint32_t piece(std::uint32_t triangle) const { return mesh_.pieces[mesh_.triangles[triangle][0]]; }
  bool cross(std::uint32_t a, std::uint32_t b) const {
    const Numbers na = points(a), nb = points(b);
    const auto in = [](std::uint32_t point, const Numbers& numbers) {
      return std::find(numbers.begin(), numbers.end(), point) != numbers.end();
    };
    if (std::count_if(na.begin(), na.end(), [&](std::uint32_t p) { return in(p, nb); }) > 1) return false;
    const Points pa = corners(a), pb = corners(b);
    const auto through = [&](const Points& p, const Numbers& np, const Points& t, const Numbers& nt) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if (!in(np[k], nt) && !in(np[next], nt) && goesThrough(p[k], p[next], t)) return true;
      }
      return false;
    };
    return through(pa, na, pb, nb) || through(pb, nb, pa, na);
  }

 private:
  Points corners(std::uint32_t triangle) const {
    const auto& t = mesh_.triangles[triangle];
    return {sim::Vec3(mesh_.positions_m[t[0]]), sim::Vec3(mesh_.positions_m[t[1]]),
            sim::Vec3(mesh_.positions_m[t[2]])};
  }
  Numbers points(std::uint32_t triangle) const {
    Numbers numbers = mesh_.triangles[triangle];
    for (std::uint32_t& corner : numbers)
      if (!mesh_.points.empty()) corner = mesh_.points[corner];
    return numbers;
  }

  const render::ModelMesh& mesh_;
};

/// By pieces, in the order of their numbers: pairs of triangles of which a side of one goes through the
/// other. Triangles that lie in one plane do not cross, nor do those that share a side, and those that share
/// a point only elsewhere.
inline std::vector<render::PiecePairs> selfCrossings(const render::ModelMesh& mesh) {
  if (mesh.empty()) return {};
  const Triangles triangles(mesh);
  return render::Boxes(triangles.boxes())
      .count([&](std::uint32_t a, std::uint32_t b) { return triangles.cross(a, b); },
             [&](std::uint32_t a) { return triangles.piece(a); });
}

}  // namespace espalier::tests
