#include "rules/growth/element_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

LimbPlace limbPlace(const sim::Skeleton& skeleton, sim::NodeId node, sim::Vec3 way) {
  const auto n = static_cast<std::size_t>(node);
  if (skeleton.parent[n] == sim::kNoNode) return {0.0, sim::perpendicular(way)};
  const auto of = [&](const char* column) { return static_cast<double>((*sim::find(skeleton, column))[n]); };
  const sim::Vec3 segment =
      skeleton.position_vx[n] - skeleton.position_vx[static_cast<std::size_t>(skeleton.parent[n])];
  const sim::Vec3 came = glm::length(segment) > 0.0 ? glm::normalize(segment) : way;
  const sim::Vec3 zero = sim::perpendicular(came);
  const glm::dvec2 turn = sim::unitCircle(of(kLimbTurnColumn));
  return {of(kLimbLengthColumn), squareTo(way, turn.x * zero + turn.y * glm::cross(came, zero))};
}

LimbQuantities atEnd(const LimbPlace& begins, sim::Vec3 way, double length_vx) {
  const sim::Vec3 zero = sim::perpendicular(way);
  // In single precision, whose library gives the same on every processor.
  const float turn = atan2f(static_cast<float>(glm::dot(begins.across, glm::cross(way, zero))),
                            static_cast<float>(glm::dot(begins.across, zero)));
  return {turn / (2.0f * std::numbers::pi_v<float>), static_cast<float>(begins.length_vx + length_vx)};
}

std::vector<ElementPlace> placesInOrder(const Phyllotaxis& phyllotaxis, double begins_vx, double ends_vx) {
  std::vector<ElementPlace> places;
  const double spacing = phyllotaxis.spacing.number;
  for (double k = std::floor(begins_vx / spacing) + 1.0; k * spacing <= ends_vx; k += 1.0) {
    for (int i = 0; i < phyllotaxis.whorl; ++i) {
      if (places.size() == kMostOnASegment) return places;
      const double turn = k * phyllotaxis.angle_deg + 360.0 * i / phyllotaxis.whorl;
      places.push_back({std::clamp((k * spacing - begins_vx) / (ends_vx - begins_vx), 0.0, 1.0),
                        std::fmod(turn, 360.0), true});
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
    const auto swayed = [&](double degrees, ElementSlot slot) {
      return sim::unitCircle((degrees + sway_deg * (2.0 * slots.uniform(slot) - 1.0)) / 360.0);
    };
    const glm::dvec2 turn = swayed(place.turn_deg, kSway);
    const glm::dvec2 pitch =
        swayed(evaluate(rule.phyllotaxis->pitch_deg, senses.circumstance, slots.uniform(kPitch)), kTilt);
    out = turn.x * across + turn.y * glm::cross(stem, across);
    element.y = glm::normalize(pitch.x * stem + pitch.y * out);
    const sim::Vec3 to_tip = squareTo(element.y, pitch.y * stem - pitch.x * out);
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
