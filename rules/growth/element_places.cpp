#include "rules/growth/element_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rules/growth/elements.h"
#include "sim/sense/proximity.h"

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

/// A vector turned about a unit one.
sim::Vec3 turned(sim::Vec3 v, sim::Vec3 about, double degrees) {
  const glm::dvec2 turn = sim::unitCircle(degrees / 360.0);
  const sim::Vec3 along = glm::dot(v, about) * about;
  return along + turn.x * (v - along) + turn.y * glm::cross(about, v);
}

/// What a pose fixes: an axis or a normal, unit; zero where it has nothing to go by.
sim::Vec3 fixedBy(Pose pose, const Senses& senses, sim::Vec3 surface) {
  switch (pose) {
    case Pose::hang:
      return {0, -1, 0};
    case Pose::stand:
      return {0, 1, 0};
    case Pose::light:
      return senses.light;
    case Pose::surface:
    case Pose::aside:
      return surface;
    case Pose::free:
      break;
  }
  return sim::Vec3(0.0);
}

/// What has no room where it belongs leans aside, and more so with each trial.
double sway(int trial, ElementSlot slot, sim::Slots& slots) {
  const double most_deg = std::min(4.0 + 4.0 * trial, 60.0);
  return most_deg * (2.0 * slots.uniform(slot) - 1.0);
}

/// Square to the stem, by phyllotaxis.
sim::Vec3 inOrder(double turn_deg, sim::Vec3 stem, sim::Vec3 across) {
  const glm::dvec2 turn = sim::unitCircle(turn_deg / 360.0);
  return turn.x * across + turn.y * glm::cross(stem, across);
}

/// stand() of what lies on a surface with this normal; `out` is where it would leave its stem, from which it
/// turns by the pitch.
void lie(sim::PlacedElement& element, const ElementPlace& place, sim::Vec3 normal, sim::Vec3 stem,
         sim::Vec3& out, double pitch_deg, int trial, sim::Slots& slots) {
  const sim::Vec3 beside = glm::cross(normal, stem);
  const bool along = glm::length(beside) > 1e-3;  // else the limb says nothing of a way in the surface
  if (along) {
    // Stalks lie on it too, to this side or that as phyllotaxis or chance turns.
    const bool other =
        place.in_order ? std::fmod(place.turn_deg + 90.0, 360.0) >= 180.0 : slots.uniform(kSway) >= 0.5;
    out = other ? -glm::normalize(beside) : glm::normalize(beside);
  }
  element.z = normal;
  const sim::Vec3 ahead = squareTo(normal, along ? stem : out);
  const glm::dvec2 pitch = sim::unitCircle(pitch_deg / 360.0);
  const sim::Vec3 way = along && pitch_deg > 0.0 ? pitch.x * ahead + pitch.y * out : ahead;
  element.y = turned(way, normal, sway(trial, kTilt, slots));
  // Or all would lie in one plane, where none may lie over another: these overlap as tiles do.
  element.position_vx += std::min(0.25 + 0.05 * trial, kMostLift) * slots.uniform(kLift) * normal;
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

sim::Vec3 surfaceNormal(const sim::World& world, sim::Vec3 place_vx) {
  // In a guide itself nothing is farther away on one side than on the other.
  const sim::Vec3 in_guide(world.guideNormalAt(sim::voxelAt(place_vx)));
  if (in_guide != sim::Vec3(0.0)) return glm::normalize(in_guide);
  const sim::Vec3 away = sim::awayFromScene(world, sim::voxelAt(place_vx));
  if (away == sim::Vec3(0.0)) return away;
  for (double step = 0.0; step <= world.layers() + 1.0; step += 0.5) {
    const sim::Voxel v = sim::voxelAt(place_vx - step * away);
    if (!sim::contains(world.frame().size, v)) break;
    const sim::Vec3 guide(world.guideNormalAt(v));
    if (guide == sim::Vec3(0.0) && !isScene(world, v)) continue;
    const sim::Vec3 normal(guide != sim::Vec3(0.0) ? guide : sim::Vec3(world.surfaceAt(v)->normal));
    const double faces = glm::dot(normal, away);
    // Distances grow about rounded edges; where the two disagree much, another sheet was hit.
    if (std::abs(faces) > 0.5) return glm::normalize(faces > 0.0 ? normal : -normal);
    break;
  }
  return away;
}

void stand(sim::PlacedElement& element, const Element& rule, const ElementPlace& place, sim::Vec3 stem,
           sim::Vec3 across, const Surroundings& around, const Senses& senses, sim::Vec3 surface, int trial,
           sim::Slots& slots) {
  const sim::Vec3 light = senses.light == sim::Vec3(0.0) ? sim::Vec3(0, 1, 0) : senses.light;
  const sim::Vec3 open = glm::normalize(0.9 * around.away + 0.8 * light + 1e-6 * sim::Vec3(0, 1, 0));
  const double face = evaluate(rule.face, senses.circumstance, slots.uniform(kFace));
  const double petiole_vx = evaluate(rule.petiole.value, senses.circumstance, slots.uniform(kPetiole));
  const sim::Vec3 fixed = fixedBy(rule.pose, senses, surface);
  const double turn_deg = place.in_order ? place.turn_deg + sway(trial, kSway, slots) : 0.0;
  sim::Vec3 out;  // square to the stem
  if (fixed != sim::Vec3(0.0)) {
    out = place.in_order ? inOrder(turn_deg, stem, across) : squareTo(stem, byItsWeight(around, stem, slots));
    if (liesFlat(rule.pose)) {
      const Value pitch = rule.phyllotaxis.value_or(Phyllotaxis()).pitch_deg;
      const double pitch_deg =
          rule.pose == Pose::surface ? 0.0 : evaluate(pitch, senses.circumstance, slots.uniform(kPitch));
      lie(element, place, fixed, stem, out, pitch_deg, trial, slots);
    } else if (rule.pose == Pose::light) {
      element.z = fixed;
      element.y = turned(squareTo(fixed, out), fixed, sway(trial, kTilt, slots));
    } else {
      const sim::Vec3 own = place.in_order ? out : onSphere(slots, kChanceTurn, kChanceHeight);
      element.y = fixed;
      element.z = turned(squareTo(fixed, glm::mix(own, open, face)), fixed, sway(trial, kTilt, slots));
    }
  } else if (place.in_order) {
    out = inOrder(turn_deg, stem, across);
    const double pitch_deg =
        evaluate(rule.phyllotaxis->pitch_deg, senses.circumstance, slots.uniform(kPitch));
    const glm::dvec2 pitch = sim::unitCircle((pitch_deg + sway(trial, kTilt, slots)) / 360.0);
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
