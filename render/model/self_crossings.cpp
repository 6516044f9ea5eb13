#include "render/model/self_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "sim/base/parallel.h"
#include "sim/base/vec.h"

namespace espalier::render {
namespace {

using sim::Vec3;
using sim::Vec3f;
using Points = std::array<Vec3, 3>;
using Numbers = std::array<std::uint32_t, 3>;

struct Box {
  Vec3f low, high;
};

/// A triangle in one cell of a grid of cubes.
struct Entry {
  std::uint64_t cell;
  std::uint32_t triangle;

  friend auto operator<=>(const Entry&, const Entry&) = default;
};

/// Six times the volume of a tetrahedron: which side of abc d lies on.
double side(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

bool goesThrough(Vec3 p, Vec3 q, const Points& t) {
  const double a = side(t[0], t[1], t[2], p), b = side(t[0], t[1], t[2], q);
  if (!((a > 0 && b < 0) || (a < 0 && b > 0))) return false;
  const double u = side(p, q, t[0], t[1]), v = side(p, q, t[1], t[2]), w = side(p, q, t[2], t[0]);
  return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

class Crossings {
 public:
  explicit Crossings(const ModelMesh& mesh) : mesh_(mesh) {
    double extent = 0.0;
    low_ = Vec3f(std::numeric_limits<float>::max());
    for (const auto& t : mesh.triangles) {
      Box box{mesh.positions_m[t[0]], mesh.positions_m[t[0]]};
      for (const std::uint32_t corner : t) {
        box.low = glm::min(box.low, mesh.positions_m[corner]);
        box.high = glm::max(box.high, mesh.positions_m[corner]);
      }
      low_ = glm::min(low_, box.low);
      const Vec3f size = box.high - box.low;
      extent += static_cast<double>(std::max({size.x, size.y, size.z}));
      boxes_.push_back(box);
    }
    cell_m_ = static_cast<float>(std::max(2.0 * extent / static_cast<double>(boxes_.size()), 1e-12));
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
      const auto from = cellOf(boxes_[i].low), to = cellOf(boxes_[i].high);
      for (std::uint64_t z = from[2]; z <= to[2]; ++z) {
        for (std::uint64_t y = from[1]; y <= to[1]; ++y) {
          for (std::uint64_t x = from[0]; x <= to[0]; ++x) entries_.push_back({keyOf({x, y, z}), i});
        }
      }
    }
    std::sort(entries_.begin(), entries_.end());
  }

  std::vector<Crossing> find() const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> found;
    std::mutex one_at_a_time;
    sim::parallelFor(entries_.size(), [&](std::size_t begin, std::size_t end) {
      std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> here;
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t j = i + 1; j < entries_.size() && entries_[j].cell == entries_[i].cell; ++j) {
          const std::uint32_t a = entries_[i].triangle, b = entries_[j].triangle;
          if (!met(a, b, entries_[i].cell) || !cross(a, b)) continue;
          ++here[std::minmax({piece(a), piece(b)})];
        }
      }
      const std::lock_guard lock(one_at_a_time);  // sums of whole numbers: the order does not matter
      for (const auto& [pieces, pairs] : here) found[pieces] += pairs;
    });
    std::vector<Crossing> result;
    for (const auto& [pieces, pairs] : found) result.push_back({pieces.first, pieces.second, pairs});
    return result;
  }

 private:
  std::array<std::uint64_t, 3> cellOf(Vec3f p) const {
    std::array<std::uint64_t, 3> cell{};
    for (int axis = 0; axis < 3; ++axis) {
      const float at = std::floor((p[axis] - low_[axis]) / cell_m_);
      cell[static_cast<std::size_t>(axis)] = static_cast<std::uint64_t>(std::clamp(at, 0.0f, 2'000'000.0f));
    }
    return cell;
  }
  static std::uint64_t keyOf(const std::array<std::uint64_t, 3>& c) {
    return c[0] | c[1] << 21u | c[2] << 42u;
  }

  /// Whether two triangles' boxes meet, and first in this cell of all that they share.
  bool met(std::uint32_t a, std::uint32_t b, std::uint64_t cell) const {
    const Box &p = boxes_[a], &q = boxes_[b];
    const Vec3f low = glm::max(p.low, q.low), high = glm::min(p.high, q.high);
    return low.x <= high.x && low.y <= high.y && low.z <= high.z && keyOf(cellOf(low)) == cell;
  }
  std::uint32_t piece(std::uint32_t triangle) const { return mesh_.pieces[mesh_.triangles[triangle][0]]; }
  Points corners(std::uint32_t triangle) const {
    const auto& t = mesh_.triangles[triangle];
    return {Vec3(mesh_.positions_m[t[0]]), Vec3(mesh_.positions_m[t[1]]), Vec3(mesh_.positions_m[t[2]])};
  }
  Numbers points(std::uint32_t triangle) const {
    Numbers numbers = mesh_.triangles[triangle];
    for (std::uint32_t& corner : numbers)
      if (!mesh_.points.empty()) corner = mesh_.points[corner];
    return numbers;
  }

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

  const ModelMesh& mesh_;
  std::vector<Box> boxes_;
  Vec3f low_{0.0f};
  float cell_m_ = 1.0f;
  std::vector<Entry> entries_;
};

}  // namespace

std::vector<Crossing> selfCrossings(const ModelMesh& mesh) {
  if (mesh.empty()) return {};
  return Crossings(mesh).find();
}

}  // namespace espalier::render
