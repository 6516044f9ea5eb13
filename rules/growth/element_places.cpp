#include "rules/growth/element_places.h"

#include <algorithm>
#include <cmath>

#include <glm/trigonometric.hpp>

namespace espalier::rules {
namespace {

/// What is left of a vector square to a unit one, as a unit vector; some vector square to it where nothing
/// is.
sim::Vec3 squareTo(sim::Vec3 unit, sim::Vec3 v) {
  const sim::Vec3 left = v - glm::dot(v, unit) * unit;
  return glm::length(left) > 1e-6 ? glm::normalize(left) : sim::perpendicular(unit);
}

sim::Vec3 onSphere(sim::Slots& slots, ElementSlot turn, ElementSlot height) {
  return sim::inCone(sim::Vec3(0, 1, 0), -1.0, slots.uniform(turn), slots.uniform(height));
}

/// Outwards and a little down.
sim::Vec3 byItsWeight(const Surroundings& around, sim::Vec3 stem, sim::Slots& slots) {
  return onSphere(slots, kOutTurn, kOutHeight) + 0.6 * around.away - 0.45 * sim::Vec3(0, 1, 0) + 0.15 * stem;
}

}  // namespace

LimbPath limbPath(const sim::Skeleton& skeleton, sim::NodeId node, sim::Vec3 heading) {
  const auto parentOf = [&](sim::NodeId n) { return skeleton.parent[static_cast<std::size_t>(n)]; };
  const auto at = [&](sim::NodeId n) { return skeleton.position_vx[static_cast<std::size_t>(n)]; };
  std::vector<sim::Vec3> steps;  // from the node back to the seed
  for (sim::NodeId n = node; parentOf(n) != sim::kNoNode; n = parentOf(n))
    steps.push_back(at(n) - at(parentOf(n)));
  LimbPath path;
  auto carry = [&, first = true](sim::Vec3 unit) mutable {
    path.across = first ? sim::perpendicular(unit) : squareTo(unit, path.across);
    first = false;
  };
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    const double length = glm::length(*step);
    path.length_vx += length;
    if (length > 0.0) carry(*step / length);
  }
  carry(heading);
  return path;
}

std::vector<ElementPlace> placesInOrder(const Phyllotaxis& phyllotaxis, double begins_vx, double length_vx) {
  std::vector<ElementPlace> places;
  const double spacing = phyllotaxis.spacing.number;
  const double ends_vx = begins_vx + length_vx;
  for (double k = std::floor(begins_vx / spacing) + 1.0; k * spacing <= ends_vx; k += 1.0) {
    for (int i = 0; i < phyllotaxis.whorl; ++i) {
      if (places.size() == kMostOnASegment) return places;
      const double turn = k * phyllotaxis.angle_deg + 360.0 * i / phyllotaxis.whorl;
      places.push_back(
          {std::clamp((k * spacing - begins_vx) / length_vx, 0.0, 1.0), std::fmod(turn, 360.0), true});
    }
  }
  return places;
}

void stand(sim::PlacedElement& element, const Element& rule, const ElementPlace& place, sim::Vec3 stem,
           sim::Vec3 across, const Surroundings& around, const Senses& senses, int trial, sim::Slots& slots) {
  const sim::Vec3 light = senses.light == sim::Vec3(0.0) ? sim::Vec3(0, 1, 0) : senses.light;
  const sim::Vec3 open = glm::normalize(0.9 * around.away + 0.8 * light + 1e-6 * sim::Vec3(0, 1, 0));
  const double face = evaluate(rule.face, senses.circumstance, slots.uniform(kFace));
  const double petiole_vx = evaluate(rule.petiole.value, senses.circumstance, slots.uniform(kPetiole));
  sim::Vec3 out;  // square to the stem
  if (place.in_order) {
    // What has no room where it belongs leans aside, and more so with each trial.
    const double sway_deg = std::min(4.0 + 4.0 * trial, 60.0);
    const double turn = glm::radians(place.turn_deg + sway_deg * (2.0 * slots.uniform(kSway) - 1.0));
    const double pitch =
        glm::radians(evaluate(rule.phyllotaxis->pitch_deg, senses.circumstance, slots.uniform(kPitch)) +
                     sway_deg * (2.0 * slots.uniform(kTilt) - 1.0));
    out = std::cos(turn) * across + std::sin(turn) * glm::cross(stem, across);
    element.y = glm::normalize(std::cos(pitch) * stem + std::sin(pitch) * out);
    const sim::Vec3 to_tip = squareTo(element.y, std::sin(pitch) * stem - std::cos(pitch) * out);
    element.z = squareTo(element.y, glm::mix(to_tip, squareTo(element.y, open), face));
  } else {
    const sim::Vec3 facing = glm::mix(onSphere(slots, kChanceTurn, kChanceHeight), open, face);
    element.z = glm::length(facing) > 1e-6 ? glm::normalize(facing) : open;
    const sim::Vec3 outward = byItsWeight(around, stem, slots);
    element.y = squareTo(element.z, outward);
    out = squareTo(stem, element.y);
  }
  element.x = glm::cross(element.y, element.z);
  element.position_vx += petiole_vx * out;
}

}  // namespace espalier::rules
