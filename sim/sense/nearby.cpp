#include <algorithm>

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

void Nearby::clear() {
  limbs_.clear();
  bodies_.clear();
  triangles_.clear();
}

void Nearby::add(const Facets& element) {
  if (element.box.low == element.box.high) return;  // a point is in nobody's way
  Body body;
  body.box = element.box;
  body.first = static_cast<std::uint32_t>(triangles_.size());
  for (std::size_t i = 0; i < element.shape->triangles.size(); ++i)
    triangles_.push_back(triangleOf(element, i));
  body.last = static_cast<std::uint32_t>(triangles_.size());
  bodies_.push_back(body);
}

bool Nearby::clash(const Facets& element, const Attachment& attachment) const {
  const std::size_t facets = element.shape->triangles.size();
  for (const Limb& limb : limbs_) {
    if (!meet(boxOf(limb.from, limb.to), element.box) || exempt(limb, attachment)) continue;
    for (std::size_t i = 0; i < facets; ++i) {
      if (pierces(limb.from, limb.to, triangleOf(element, i))) return true;
    }
  }
  for (const Body& body : bodies_) {
    if (!meet(body.box, element.box)) continue;
    for (std::size_t i = 0; i < facets; ++i) {
      const LatticeTriangle mine = triangleOf(element, i);
      if (!meet(body.box, boxOf(mine))) continue;
      for (std::uint32_t k = body.first; k < body.last; ++k) {
        if (cross(mine, triangles_[k])) return true;
      }
    }
  }
  return false;
}

bool Nearby::clash(const Limb& limb) const {
  const LatticeBox box = boxOf(limb.from, limb.to);
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
    if (!meet(body.box, box)) return false;
    const auto first = triangles_.begin() + body.first, last = triangles_.begin() + body.last;
    return std::any_of(first, last, [&](const LatticeTriangle& t) { return pierces(limb.from, limb.to, t); });
  });
}

}  // namespace espalier::sim
