#include <algorithm>
#include <utility>

#include "sim/base/stop.h"
#include "sim/sense/piece_grid.h"

namespace espalier::sim {
namespace {

bool exempt(const Limb& limb, const Attachment& attachment) {
  return limb.from == attachment.at || limb.to == attachment.at ||
         (limb.stem == attachment.stem && limb.node == attachment.node);
}

LatticeTriangle triangleOf(const Facets& element, std::size_t i) {
  const auto& corners = element.shape->triangles[i];
  return {element.corners[corners[0]], element.corners[corners[1]], element.corners[corners[2]]};
}

}  // namespace

/// Whether two boxes share no point.
bool Nearby::apart(const Bounds& a, const Bounds& b) {
  int signs = 0;  // one is negative where the boxes are apart; no branches, so that lanes do it
  for (int i = 0; i < 4; ++i) signs |= (b.high[i] - a.low[i]) | (a.high[i] - b.low[i]);
  return signs < 0;
}

namespace {

/// Whether all corners lie beyond one of two planes: by more than rounding of the arithmetic could feign.
class Beyond {
 public:
  Beyond(const Vec3& normal, double low, double high) : normal_(normal), low_(low), high_(high) {}

  /// False as soon as it is settled that they do not.
  bool add(LatticePoint corner) {
    constexpr double kMargin = 0.5;
    const double at = glm::dot(normal_, Vec3(corner));
    above_ = above_ && at > high_ + kMargin;
    below_ = below_ && at < low_ - kMargin;
    return above_ || below_;
  }

 private:
  Vec3 normal_;
  double low_, high_;
  bool above_ = true, below_ = true;
};

}  // namespace

bool Nearby::apart(const Slab& slab, std::span<const Facet> facets) {
  Beyond beyond(slab.normal, slab.low, slab.high);
  return std::all_of(facets.begin(), facets.end(), [&](const Facet& facet) {
    return std::all_of(facet.corners.begin(), facet.corners.end(),
                       [&](LatticePoint corner) { return beyond.add(corner); });
  });
}

bool Nearby::apart(const Slab& slab, const Facets& element) {
  Beyond beyond(slab.normal, slab.low, slab.high);
  return std::all_of(element.corners.begin(), element.corners.end(),
                     [&](LatticePoint corner) { return beyond.add(corner); });
}

Nearby::Slab Nearby::slabOf(std::span<const Facet> facets) {
  Slab slab;
  for (const Facet& facet : facets) {
    const Vec3 u(facet.corners[1] - facet.corners[0]), v(facet.corners[2] - facet.corners[0]);
    slab.normal += glm::cross(u, v);
  }
  const double length = glm::length(slab.normal);
  slab.normal = length > 0.0 ? slab.normal / length : Vec3(0, 1, 0);
  slab.low = slab.high = glm::dot(slab.normal, Vec3(facets[0].corners[0]));
  for (const Facet& facet : facets) {
    for (const LatticePoint corner : facet.corners) {
      const double at = glm::dot(slab.normal, Vec3(corner));
      slab.low = std::min(slab.low, at);
      slab.high = std::max(slab.high, at);
    }
  }
  return slab;
}

Nearby::Facet::Facet(const LatticeBox& box, const LatticeTriangle& t)
    : bounds(box), corners(t), normal(near(box, box) ? normalOf(t) : glm::i64vec3(0)) {}

void Nearby::clear() {
  limb_bounds_.clear();
  limbs_.clear();
  body_bounds_.clear();
  bodies_.clear();
  facets_.clear();
}

void Nearby::add(const Facets& element) {
  if (element.box.low == element.box.high) return;  // a point is in nobody's way
  Body body;
  body.first = static_cast<std::uint32_t>(facets_.size());
  for (std::size_t i = 0; i < element.shape->triangles.size(); ++i) {
    const LatticeTriangle corners = triangleOf(element, i);
    facets_.emplace_back(boxOf(corners), corners);
  }
  body.last = static_cast<std::uint32_t>(facets_.size());
  body.slab = slabOf(std::span(facets_).subspan(body.first));
  bodies_.push_back(body);
  body_bounds_.emplace_back(element.box);
}

void Nearby::open(Body& body) {
  if (body.last > 0) return;
  body.first = static_cast<std::uint32_t>(facets_.size());
  grid_->unpack(body.number, facets_);
  body.last = static_cast<std::uint32_t>(facets_.size());
  body.slab = slabOf(std::span(facets_).subspan(body.first));
}

/// Whether the element that is asked of crosses one that is open; both may be near each other.
bool Nearby::cross(const Body& body, bool near) const {
  const auto facets = std::span(facets_).subspan(body.first, body.last - body.first);
  if (apart(asked_slab_, facets)) return false;
  for (const Facet& mine : asked_) {
    throwIfStopped();  // of shapes with thousands of triangles each asks thousands
    for (const Facet& other : facets) {
      if (apart(mine.bounds, other.bounds)) continue;
      if (near ? crossNear(mine.corners, mine.normal, other.corners, other.normal)
               : sim::cross(mine.corners, other.corners))
        return true;
    }
  }
  return false;
}

bool Nearby::clash(const Facets& element, const Attachment& attachment) {
  const std::size_t facets = element.shape->triangles.size();
  const Bounds bounds(element.box);
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    const Limb& limb = limbs_[i];
    if (apart(limb_bounds_[i], bounds) || exempt(limb, attachment)) continue;
    for (std::size_t k = 0; k < facets; ++k) {
      if (pierces(limb.from, limb.to, triangleOf(element, k))) return true;
    }
  }
  asked_.clear();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (apart(body_bounds_[i], bounds)) continue;
    open(bodies_[i]);
    if (apart(bodies_[i].slab, element)) continue;
    if (asked_.empty()) {
      for (std::size_t k = 0; k < facets; ++k) {
        const LatticeTriangle corners = triangleOf(element, k);
        asked_.emplace_back(boxOf(corners), corners);
      }
      asked_slab_ = slabOf(asked_);
    }
    const LatticeBox other{body_bounds_[i].low, body_bounds_[i].high};
    if (!cross(bodies_[i], near(element.box, other))) continue;
    // What is in the way once is likely to be so again: it is asked first.
    std::swap(bodies_[i], bodies_[i / 2]);
    std::swap(body_bounds_[i], body_bounds_[i / 2]);
    return true;
  }
  return false;
}

bool Nearby::clash(const Limb& limb) {
  const Bounds bounds(boxOf(limb.from, limb.to));
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (apart(body_bounds_[i], bounds)) continue;
    open(bodies_[i]);
    for (std::uint32_t k = bodies_[i].first; k < bodies_[i].last; ++k) {
      if (pierces(limb.from, limb.to, facets_[k].corners)) return true;
    }
  }
  return false;
}

}  // namespace espalier::sim
