#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "rules/growth/random_tree.h"
#include "rules/growth/ways.h"
#include "tests/support/plain_feelers.h"

/// Trials one by one and number by number: what the lanes of rules/growth/ways must give bit for bit.
namespace espalier::tests {

struct PlainCircle {
  float cosine, sine;
};
inline PlainCircle plainCircle(float turns) {
  const float quarters = std::floor(turns * 4.0f + 0.5f);
  const float x = (turns - quarters * 0.25f) * 6.28318530717958648f, x2 = x * x;
  float s = x2 * (1.0f / 362880);
  for (const float term : {-1.0f / 5040, 1.0f / 120, -1.0f / 6}) s = (s + term) * x2;
  s = x + x * s;
  float c = x2 * (1.0f / 40320);
  for (const float term : {-1.0f / 720, 1.0f / 24, -1.0f / 2}) c = (c + term) * x2;
  c = c + 1.0f;
  switch (static_cast<int>(quarters) & 3) {
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    case 3:
      return {s, -c};
    default:
      return {c, s};
  }
}

inline float plainLength(sim::Vec3f v) {
  return std::sqrt((v.x * v.x + v.y * v.y) + v.z * v.z);
}

inline sim::Vec3f plainLeaning(sim::Vec3f axis, float along, float across, float turn) {
  const sim::Vec3f a = glm::abs(axis);
  const sim::Vec3f helper = a.x <= a.y && a.x <= a.z ? sim::Vec3f(1, 0, 0)
                            : a.y <= a.z             ? sim::Vec3f(0, 1, 0)
                                                     : sim::Vec3f(0, 0, 1);
  sim::Vec3f u = glm::cross(axis, helper);
  u = u / plainLength(u);
  const sim::Vec3f v = glm::cross(axis, u);
  const PlainCircle side = plainCircle(turn);
  return axis * along + (u * side.cosine + v * side.sine) * across;
}

inline float plainLogarithm(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t octave = (bits - 0x3f3504f3) >> 23;
  const float m = std::bit_cast<float>(bits - octave * (1 << 23)), z = (m - 1.0f) / (m + 1.0f), z2 = z * z;
  float sum = z2 * (1.0f / 9);
  for (const float term : {1.0f / 7, 1.0f / 5, 1.0f / 3}) sum = (sum + term) * z2;
  return static_cast<float>(octave) * 0.69314718055994531f + 2.0f * z * (1.0f + sum);
}

inline float plainShare(const rules::AngleDensity& angles, float even) {
  std::size_t i = 0;
  while (i + 1 < angles.count && even >= angles.pieces[i + 1].from) ++i;
  const rules::AngleDensity::Piece& piece = angles.pieces[i];
  const float part = std::min(1.0f, (even - piece.from) * piece.per_share);
  const float square = piece.low * piece.low + 2.0f * piece.rise * part;
  const float below = piece.low + std::sqrt(std::max(0.0f, square));
  return piece.at + piece.span * std::min(1.0f, 2.0f * part / std::max(1e-20f, below));
}

struct PlainLean {
  float along, across;
};
inline PlainLean plainLean(const rules::Ways& ways, float wander, float even) {
  const auto circleOf = [](float degrees) { return plainCircle(std::min(180.0f, degrees) * (1.0f / 360)); };
  switch (ways.wanders) {
    case rules::AngleDistribution::cone:
      break;
    case rules::AngleDistribution::gaussian: {
      const PlainCircle lean = circleOf(wander * std::sqrt(-2.0f * plainLogarithm(1.0f - even)));
      return {lean.cosine, lean.sine};
    }
    case rules::AngleDistribution::table: {
      const PlainCircle lean = circleOf(wander * plainShare(ways.angles, even));
      return {lean.cosine, lean.sine};
    }
  }
  const float along = 1.0f - even * (1.0f - circleOf(wander).cosine);
  return {along, std::sqrt(std::max(0.0f, 1.0f - along * along))};
}

inline sim::Fixed plainTrialEnd(const rules::Ways& ways, const sim::RandomKey& key, unsigned set, int trial) {
  sim::Slots slots(key, sim::Purpose::trial, set, static_cast<unsigned>(trial));
  const auto uniform = [&](rules::TrialSlot slot) { return slots.uniformFloat(static_cast<unsigned>(slot)); };
  const auto value = [&](rules::Spread s, rules::TrialSlot slot) {
    return s.span == 0.0f ? s.low : s.low + s.span * uniform(slot);
  };
  sim::Vec3f axis = ways.axis;
  if (ways.branch) {
    const PlainCircle angle =
        plainCircle(value(ways.side_angle_deg, rules::TrialSlot::side_angle) * (1.0f / 360));
    axis = plainLeaning(axis, angle.cosine, angle.sine, uniform(rules::TrialSlot::side_turn));
  }
  float widening = 1.0f;
  if (trial >= ways.narrow) {
    widening += static_cast<float>(trial - ways.narrow + 1) /
                static_cast<float>(std::max(1, ways.widest - ways.narrow));
  }
  const PlainLean lean = plainLean(ways, widening * value(ways.wander_deg, rules::TrialSlot::wander),
                                   uniform(rules::TrialSlot::cone_height));
  sim::Vec3f direction = plainLeaning(axis, lean.along, lean.across, uniform(rules::TrialSlot::cone_turn));
  for (std::size_t i = 0; i < ways.pull_count; ++i) {
    const rules::Pull& pull = ways.pulls[i];
    const float weight = value(pull.weight, pull.slot);
    if (weight == 0.0f) continue;
    const sim::Vec3f towards = weight < 0.0f ? -pull.towards : pull.towards;
    const sim::Vec3f mixed = direction * (1.0f - std::abs(weight)) + towards * std::abs(weight);
    const float length = plainLength(mixed);
    if (length > 1e-6f) direction = mixed / length;
  }
  if (ways.flat[0] || ways.flat[1] || ways.flat[2]) {
    for (std::size_t axis_number = 0; axis_number < 3; ++axis_number) {
      if (ways.flat[axis_number]) direction[static_cast<int>(axis_number)] = 0.0f;
    }
    const float length = plainLength(direction);
    direction = length > 1e-6f ? direction / length : sim::Vec3f(0.0f);
  }
  const float length = value(ways.length_vx, rules::TrialSlot::length) * 4096.0f;
  const sim::Vec3f end = direction * length;
  return {std::llrint(end.x), std::llrint(end.y), std::llrint(end.z)};
}

/// rules::bestTrial, trial by trial.
inline std::optional<rules::Candidate> plainBestTrial(const sim::SiteView& view, const rules::RuleSet& rules,
                                                      const rules::Surroundings& around,
                                                      const rules::Senses& senses, const sim::RandomKey& key,
                                                      unsigned set, sim::OutcomeCounts& counts) {
  const rules::Ways ways = rules::waysOf(rules, around, senses, key, set, view.world.frame().size);
  const auto passage = rules.require.clear ? sim::Passage::around : sim::Passage::through;
  std::optional<rules::Candidate> best;
  double best_score = std::numeric_limits<double>::infinity();
  const int enough = rules.prefer.has_proximity ? rules.random_tree.trials_min : 1;
  for (int i = 0; i < rules.random_tree.trials_max && !(best && i >= enough); ++i) {
    const sim::Fixed end = sim::fixedFromVoxel(around.at_vx) + plainTrialEnd(ways, key, set, i);
    const sim::Vec3 to_vx = sim::Vec3(end) / 4096.0;
    const PlainFelt felt = plainFeel(view.world, around.at_vx, to_vx, around.attachment, passage);
    const double proximity_vx = felt.proximity_vx;
    sim::Outcome outcome = sim::Outcome::grown;
    if (felt.fate == sim::Fit::outside)
      outcome = sim::Outcome::out_of_world;
    else if (felt.fate == sim::Fit::blocked)
      outcome = sim::Outcome::blocked;
    else if (proximity_vx > rules.require.proximity_max.number)
      outcome = sim::Outcome::too_far;
    else if (proximity_vx < rules.require.proximity_min.number)
      outcome = sim::Outcome::too_near;
    ++counts[static_cast<std::size_t>(outcome)];
    if (outcome != sim::Outcome::grown) continue;
    const double score =
        rules.prefer.has_proximity ? std::abs(proximity_vx - rules.prefer.proximity.number) : 0.0;
    if (score >= best_score) continue;
    best_score = score;
    best = rules::Candidate{to_vx, {}, {}, passage, proximity_vx};
  }
  return best;
}

}  // namespace espalier::tests
