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

/// Something in one cell of a grid of cubes.
struct Entry {
  std::uint64_t cell;
  std::uint32_t item;

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

/// Boxes in a grid of cubes about twice as wide as they are on the mean.
class Boxes {
 public:
  explicit Boxes(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
    double extent = 0.0;
    for (const Box& box : boxes_) {
      low_ = glm::min(low_, box.low);
      const Vec3f size = box.high - box.low;
      extent += static_cast<double>(std::max({size.x, size.y, size.z}));
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

  using Pieces = std::pair<std::uint32_t, std::uint32_t>;
  /// Of all pairs of boxes that meet how many are counted for each pair of pieces.
  /// `counts(a, b)`: of two boxes, in parallel; `piece(a)`: what a box belongs to.
  template <class Counts, class Piece>
  std::vector<Crossing> count(Counts counts, Piece piece) const {
    std::map<Pieces, std::size_t> found;
    std::mutex one_at_a_time;
    sim::parallelFor(entries_.size(), [&](std::size_t begin, std::size_t end) {
      std::map<Pieces, std::size_t> here;
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t j = i + 1; j < entries_.size() && entries_[j].cell == entries_[i].cell; ++j) {
          const std::uint32_t a = entries_[i].item, b = entries_[j].item;
          if (met(a, b, entries_[i].cell) && counts(a, b)) ++here[std::minmax({piece(a), piece(b)})];
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

  /// Whether two boxes meet, and first in this cell of all that they share.
  bool met(std::uint32_t a, std::uint32_t b, std::uint64_t cell) const {
    const Box &p = boxes_[a], &q = boxes_[b];
    const Vec3f low = glm::max(p.low, q.low), high = glm::min(p.high, q.high);
    return low.x <= high.x && low.y <= high.y && low.z <= high.z && keyOf(cellOf(low)) == cell;
  }

  std::vector<Box> boxes_;
  Vec3f low_{std::numeric_limits<float>::max()};
  float cell_m_ = 1.0f;
  std::vector<Entry> entries_;
};

/// The triangles of a mesh.
class Triangles {
 public:
  explicit Triangles(const ModelMesh& mesh) : mesh_(mesh) {}

  std::vector<Box> boxes() const {
    std::vector<Box> boxes;
    for (const auto& t : mesh_.triangles) {
      Box box{mesh_.positions_m[t[0]], mesh_.positions_m[t[0]]};
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
    return {Vec3(mesh_.positions_m[t[0]]), Vec3(mesh_.positions_m[t[1]]), Vec3(mesh_.positions_m[t[2]])};
  }
  Numbers points(std::uint32_t triangle) const {
    Numbers numbers = mesh_.triangles[triangle];
    for (std::uint32_t& corner : numbers)
      if (!mesh_.points.empty()) corner = mesh_.points[corner];
    return numbers;
  }

  const ModelMesh& mesh_;
};

/// A stretch of a limb between two stations.
struct Stretch {
  std::uint32_t limb, station;
};

/// How near two straight lines come to each other, and where on each, 0..1.
struct Nearest {
  double distance, on_a, on_b;
};
Nearest nearest(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), uw = glm::dot(u, w),
               vw = glm::dot(v, w);
  const double area = uu * vv - uv * uv;
  double s = area > 1e-12 * uu * vv ? std::clamp((uv * vw - vv * uw) / area, 0.0, 1.0) : 0.0;
  const double t = std::clamp((uv * s + vw) / vv, 0.0, 1.0);
  s = std::clamp((uv * t - uw) / uu, 0.0, 1.0);
  return {glm::distance(a + s * u, c + t * v), s, t};
}

/// Whether two limbs run into each other at two of their stretches, other than where one leaves the other.
bool meet(const std::vector<Limb>& limbs, Stretch p, Stretch q) {
  const Limb &a = limbs[p.limb], &b = limbs[q.limb];
  const Nearest at = nearest(a.line[p.station].centre_m, a.line[p.station + 1].centre_m,
                             b.line[q.station].centre_m, b.line[q.station + 1].centre_m);
  const auto radius = [](const Limb& limb, std::size_t i, double share) {
    return glm::mix(limb.line[i].radius_m, limb.line[i + 1].radius_m, share);
  };
  const auto arc = [](const Limb& limb, std::size_t i, double share) {
    return glm::mix(limb.arcs_m[i], limb.arcs_m[i + 1], share);
  };
  const double thick = radius(a, p.station, at.on_a) + radius(b, q.station, at.on_b);
  if (at.distance >= thick) return false;
  const double along_a = arc(a, p.station, at.on_a), along_b = arc(b, q.station, at.on_b);
  if (p.limb == q.limb) return std::abs(along_a - along_b) > 4.0 * thick;
  if (b.host == static_cast<std::int32_t>(p.limb)) return along_b > 2.0 * thick;
  if (a.host == static_cast<std::int32_t>(q.limb)) return along_a > 2.0 * thick;
  return true;
}

}  // namespace

std::vector<Crossing> selfCrossings(const ModelMesh& mesh) {
  if (mesh.empty()) return {};
  const Triangles triangles(mesh);
  return Boxes(triangles.boxes())
      .count([&](std::uint32_t a, std::uint32_t b) { return triangles.cross(a, b); },
             [&](std::uint32_t a) { return triangles.piece(a); });
}

std::size_t meetingLimbs(const std::vector<Limb>& limbs) {
  std::vector<Stretch> stretches;
  std::vector<Box> boxes;
  for (std::size_t l = 0; l < limbs.size(); ++l) {
    for (std::size_t i = 0; i + 1 < limbs[l].line.size(); ++i) {
      const TubeStation &a = limbs[l].line[i], &b = limbs[l].line[i + 1];
      const Vec3 thick(std::max(a.radius_m, b.radius_m));
      stretches.push_back({static_cast<std::uint32_t>(l), static_cast<std::uint32_t>(i)});
      boxes.push_back(
          {Vec3f(glm::min(a.centre_m, b.centre_m) - thick), Vec3f(glm::max(a.centre_m, b.centre_m) + thick)});
    }
  }
  if (boxes.empty()) return 0;
  return Boxes(std::move(boxes))
      .count([&](std::uint32_t a, std::uint32_t b) { return meet(limbs, stretches[a], stretches[b]); },
             [&](std::uint32_t a) { return stretches[a].limb; })
      .size();
}

}  // namespace espalier::render
