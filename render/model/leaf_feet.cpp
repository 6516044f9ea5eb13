#include "render/model/leaf_feet.h"

#include <algorithm>

#include "render/model/leaves.h"
#include "render/model/limbs.h"

namespace espalier::render {

using sim::Vec3;

namespace {

// Of a radius: where a foot stands. A ring's sides lie inside of its circle.
constexpr double kSunk = 0.7;

}  // namespace

bool LeafFeet::isInTheWay(const sim::PlacedElement& element) const {
  for (const auto& polygon : plant_.shapes[static_cast<std::size_t>(element.shape)].polygons) {
    for (const Vec3 corner : polygon)
      if (blocked_(sim::placed(element, corner))) return true;
  }
  return false;
}

LeafFoot LeafFeet::of(const sim::PlacedElement& element) const {
  const sim::Skeleton& skeleton = plant_.skeleton;
  LeafFoot foot{element, element.position_vx, 0.0};
  if (element.node < 0 || element.node >= skeleton.size()) return foot;
  const sim::NodeId parent = at(skeleton.parent, element.node);
  if (parent == sim::kNoNode) return foot;
  const Vec3 from = at(skeleton.position_vx, parent), segment = at(skeleton.position_vx, element.node) - from;
  const double length2 = glm::dot(segment, segment);
  if (!(length2 > 0.0)) return foot;
  const double along = glm::dot(element.position_vx - from, segment) / length2;
  const Vec3 on_segment = from + along * segment;
  foot.stem_vx = on_segment;
  const auto stem = static_cast<std::size_t>(at(curves_.stem_of, element.node));
  const Limb& limb = limbs_[stem];
  if (limb.line.empty()) return foot;
  const double param = at(curves_.parameter_of, element.node) - 1.0 + std::clamp(along, 0.0, 1.0);
  const Vec3 on_curve = curves_.stems[stem].curve.position(std::max(param, 0.0));
  const NearLine near = nearestOn(limb, stretchAt(limb, param), sim::worldFromVoxel(frame_, on_curve));
  foot.stem_vx = sim::voxelFromWorld(frame_, near.centre_m);
  foot.radius_vx = near.radius_m / frame_.voxel_m;

  const auto squareToSegment = [&](Vec3 v) { return v - glm::dot(v, segment) / length2 * segment; };
  Vec3 out = squareToSegment(element.position_vx - on_segment);
  if (glm::length(out) < 1e-6) out = squareToSegment(element.y);
  sim::PlacedElement moved = element;
  moved.position_vx += foot.stem_vx - on_segment;
  if (glm::length(out) > 1e-6) moved.position_vx += kSunk * foot.radius_vx * glm::normalize(out);
  if (!blocked_ || !isInTheWay(moved) || isInTheWay(element)) foot.element = moved;
  return foot;
}

}  // namespace espalier::render
