#include "rules/growth/bend.h"

#include <algorithm>
#include <cmath>

namespace espalier::rules {
namespace {

double cosineOfDegrees(double degrees) {
  return sim::unitCircle(degrees / 360.0).x;
}

sim::Vec3 bent(sim::Vec3 direction, sim::Vec3 towards, double weight) {
  if (weight == 0.0 || towards == sim::Vec3(0.0)) return direction;
  const sim::Vec3 mixed = glm::mix(direction, towards, weight);
  const double length = glm::length(mixed);
  return length > 1e-9 ? mixed / length : direction;
}

double uniform(sim::Slots& slots, TrialSlot slot) {
  return slots.uniform(static_cast<unsigned>(slot));
}

/// A way that leaves the limb's at an angle, on a side by chance.
sim::Vec3 aside(sim::Vec3 heading, double degrees, double turn) {
  const glm::dvec2 angle = sim::unitCircle(degrees / 360.0), side = sim::unitCircle(turn);
  const sim::Vec3 u = sim::perpendicular(heading), v = glm::cross(heading, u);
  return angle.x * heading + angle.y * (side.x * u + side.y * v);
}

}  // namespace

double valueOf(const Value& value, const Circumstance& at, sim::Slots& slots, TrialSlot slot) {
  return evaluate(value, at, value.kind == Value::Kind::range ? uniform(slots, slot) : 0.0);
}

sim::Vec3 trialDirection(const RuleSet& rules, const Surroundings& around, const Senses& senses, bool branch,
                         double widening, sim::Slots& slots) {
  const auto number = [&](const Value& value, TrialSlot slot) {
    return valueOf(value, senses.circumstance, slots, slot);
  };
  // A seed has no way of its own yet: a shoot makes for the open above, or along the wall that it stands at.
  sim::Vec3 axis(0, 1, 0);
  double cos_half_angle = 0.5;
  if (around.heading != sim::Vec3(0.0)) {
    axis = around.heading;
    if (branch) {
      axis = aside(axis, number(rules.random_tree.branch_angle_deg, TrialSlot::side_angle),
                   uniform(slots, TrialSlot::side_turn));
    }
    cos_half_angle =
        cosineOfDegrees(std::min(180.0, widening * number(rules.random_tree.wander_deg, TrialSlot::wander)));
  }
  sim::Vec3 direction = sim::inCone(axis, cos_half_angle, uniform(slots, TrialSlot::cone_turn),
                                    uniform(slots, TrialSlot::cone_height));
  const Bias& bias = rules.bias;
  direction = bent(direction, sim::Vec3(0, 1, 0), number(bias.up, TrialSlot::up));
  direction = bent(direction, sim::Vec3(0, -1, 0), number(bias.gravity, TrialSlot::gravity));
  direction = bent(direction, senses.light, number(bias.light, TrialSlot::light));
  direction = bent(direction, around.away, number(bias.away, TrialSlot::away));
  direction = bent(direction, -around.away, number(bias.toward, TrialSlot::toward));
  const double twist = number(bias.twist, TrialSlot::twist);
  return bent(direction, twist < 0.0 ? -senses.twist : senses.twist, std::abs(twist));
}

}  // namespace espalier::rules
