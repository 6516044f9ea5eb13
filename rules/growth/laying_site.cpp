#include "rules/growth/laying_site.h"

#include <algorithm>
#include <cmath>

#include "rules/diffusion/beside.h"
#include "rules/growth/laid_pose.h"
#include "rules/growth/laid_room.h"
#include "rules/growth/trial_judge.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

/// Random numbers of a trial, by their slots (sim::Slots).
enum LayingSlot : unsigned {
  kSize,
  kFar,
  kSide,
  kTurn,
  kTilt,
  kTiltSide,
  kTurnMost,
  kTiltMost,
  kStep,
  kFirst,
  kAlongX = 12,  // four each
  kAlongY = 16,
};

/// Evenly from the sum of four even numbers: about normal, of deviation 1, and never beyond 3.5.
double bell(sim::Slots& slots, unsigned first) {
  double sum = -2.0;
  for (unsigned i = 0; i < 4; ++i) sum += slots.uniform(first + i);
  return 1.7320508075688772 * sum;
}

/// Up to `most` to either side, in whole steps if there are any.
double turnBy(double most_deg, double step_deg, double draw) {
  const double turn = most_deg * (2.0 * draw - 1.0);
  if (!(step_deg > 0.0)) return turn;
  // As likely to the one side as to the other, and each step as likely as any.
  const double steps = std::floor(most_deg / step_deg + 1e-9);
  return step_deg * (std::floor((2.0 * steps + 1.0) * draw) - steps);
}

class Layer {
 public:
  Layer(const sim::SiteView& view, const LayingSite& site, const RuleSet& rules, const Surroundings& around,
        const Senses& senses, std::int32_t first_shape, const sim::RandomKey& key, sim::Proposal& proposal)
      : view_(view),
        site_(site),
        rules_(rules),
        diffusion_(rules.diffusion),
        around_(around),
        senses_(senses),
        key_(key),
        first_shape_(first_shape),
        proposal_(proposal),
        room_(view, site, rules.diffusion) {
    measure();
  }

  /// `item` tells the draws of its shapes apart.
  std::optional<sim::ProposedElement> lay(std::int32_t shape, unsigned item) {
    const LaidKind& kind = (*site_.kinds)[static_cast<std::size_t>(shape)];
    sim::Slots slots(key_, sim::Purpose::element, item);
    if (diffusion_.around != Around::edges || !kind.flat || site_.beside == nullptr ||
        !site_.beside_kind->flat)
      return layByChance(shape, kind, item);
    if (!looked_) room_.look(site_.stance, farthest() + radius_ + nearby_vx(), low_vx_, high_vx_);
    looked_ = true;
    const double scale =
        evaluate(kind.rule->size, senses_.circumstance, slots.uniform(kSize)) * senses_.vigour;
    return layBeside(shape, kind, scale, slots);
  }

 private:
  /// How far the elements of the rule set reach, and those of all that may lie there.
  void measure() {
    for (std::size_t i = 0; i < rules_.elements.size(); ++i) {
      const LaidKind& kind = (*site_.kinds)[static_cast<std::size_t>(first_shape_) + i];
      const double scale = highest(kind.rule->size) * senses_.vigour;
      radius_ = std::max(radius_, kind.reach * scale);
      if (!kind.flat) continue;
      high_vx_ = std::max(high_vx_, kind.high * scale);
      low_vx_ = -diffusion_.off.number;
    }
    for (const LaidKind& kind : *site_.kinds)
      off_foot_ = std::max(off_foot_, kind.off_foot * highest(kind.rule->size) * senses_.vigour);
  }

  /// From the one foot to the other, at most.
  double farthest() const {
    const bool beside = site_.beside != nullptr;
    return farthestFoot(diffusion_, beside ? site_.beside_kind->reach * site_.beside->scale : 0.0, radius_);
  }

  /// As far as neighbours are looked for.
  double nearby_vx() const {
    return diffusion_.gap_max.number < kNoLimit ? diffusion_.gap_max.number : diffusion_.gap_min.number;
  }

  /// What has sides in one plane crosses there: without a gap tiles would be their own neighbours' hindrance.
  double gapOfEdges() const {
    constexpr double kHair_vx = 1.0 / 1024.0;
    return std::max(diffusion_.gap_min.number, kHair_vx);
  }

  Tilt tiltOf(sim::Slots& slots) const {
    const double most_deg = evaluate(diffusion_.tilt_deg, senses_.circumstance, slots.uniform(kTiltMost));
    return {most_deg * slots.uniform(kTilt), slots.uniform(kTiltSide)};
  }

  /// What finds no place at its seed is tried farther and farther from it.
  glm::dvec2 aboutSeed(const LaidKind& kind, double scale, int trial, sim::Slots& slots) const {
    constexpr double kFarthest = 3.0;  // times how far it reaches itself
    const double far = kFarthest * kind.reach * scale * trial / kind.rule->trials;
    return far * sim::unitCircle(slots.uniform(kSide));
  }

  std::optional<sim::ProposedElement> layBeside(std::int32_t shape, const LaidKind& kind, double scale,
                                                sim::Slots& slots) {
    Outline own = kind.outline;
    for (glm::dvec2& corner : own) corner *= scale;
    const Outline parent = outlineAbout(site_.stance, *site_.beside, *site_.beside_kind);
    const double most_deg = evaluate(diffusion_.turn_deg, senses_.circumstance, slots.uniform(kTurnMost));
    const double askew_deg = turnBy(most_deg, diffusion_.turn_step_deg, slots.uniform(kTurn));
    const Tilt tilt = tiltOf(slots);
    std::vector<Laid> places = placesBeside(parent, own, kind.edges, gapOfEdges(), room_.outlines(),
                                            sim::unitCircle(askew_deg / 360.0));
    // What lies along most of its rim leaves the fewest holes; among equals chance decides.
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double chance =
          sim::Slots(key_, sim::Purpose::element, 65'535, static_cast<unsigned>(i % 65'536)).uniform(kFirst);
      order.emplace_back(-std::round(places[i].contact * 1000.0) + 0.5 * chance, i);
    }
    std::sort(order.begin(), order.end());
    if (order.size() > static_cast<std::size_t>(kind.rule->trials))
      order.resize(static_cast<std::size_t>(kind.rule->trials));
    if (order.empty()) count(Outcome::blocked, site_.stance.at_vx);
    // A plane's own +y is the outline's +y.
    for (const auto& [rank, i] : order) {
      if (auto laid = tryAt(shape, kind, scale, {places[i].by, places[i].turn}, tilt, true)) return laid;
    }
    return std::nullopt;
  }

  std::optional<sim::ProposedElement> layByChance(std::int32_t shape, const LaidKind& kind, unsigned item) {
    looked_ = false;
    std::optional<TrialJudge> judge;
    if (rules_.prefer.any() || !rules_.require.along.empty())
      judge.emplace(view_, rules_, around_, static_cast<int>(std::ceil(farthest())) + 2);
    std::optional<sim::ProposedElement> best;
    double best_score = 0.0;
    const int trials = std::min(kind.rule->trials, ways(kind));
    for (int trial = 0; trial < trials; ++trial) {
      sim::Slots slots(key_, sim::Purpose::element, item, static_cast<unsigned>(trial));
      const double scale =
          evaluate(kind.rule->size, senses_.circumstance, slots.uniform(kSize)) * senses_.vigour;
      const double most_deg = evaluate(diffusion_.turn_deg, senses_.circumstance, slots.uniform(kTurnMost));
      const double turn_deg = turnBy(most_deg, diffusion_.turn_step_deg, slots.uniform(kTurn));
      const LaidWay way{
          site_.beside == nullptr ? aboutSeed(kind, scale, trial, slots) : offset(slots, item, trial),
          sim::unitCircle(turn_deg / 360.0)};
      auto laid = tryAt(shape, kind, scale, way, tiltOf(slots), false);
      if (!laid) continue;
      if (!judge) return laid;
      const sim::Vec3 to_vx = laid->element.position_vx;
      if (const Outcome outcome = judge->judged(to_vx, 0.0); outcome != Outcome::grown) {
        --proposal_.trials[static_cast<std::size_t>(Outcome::grown)];
        ++proposal_.trials[static_cast<std::size_t>(outcome)];
        if (view_.record_attempts) proposal_.attempts.back().outcome = outcome;
        continue;
      }
      if (!rules_.prefer.any()) return laid;
      const double score = judge->scoreOf(to_vx, 0.0);
      if (best && score >= best_score) continue;
      best_score = score;
      best = std::move(laid);
    }
    return best;
  }

  /// In how many ways an element can be laid that differ.
  int ways(const LaidKind& kind) const {
    const Value none(0.0);
    const bool exact = diffusion_.around == Around::steps && diffusion_.far() == none &&
                       diffusion_.turn_deg == none && diffusion_.tilt_deg == none &&
                       kind.rule->size.kind != Value::Kind::range;
    return exact ? static_cast<int>(diffusion_.steps.size()) : kind.rule->trials;
  }

  glm::dvec2 offset(sim::Slots& slots, unsigned item, int trial) const {
    const double far = evaluate(diffusion_.far(), senses_.circumstance, slots.uniform(kFar));
    const glm::dvec2 about(bell(slots, kAlongX), bell(slots, kAlongY));
    if (diffusion_.around == Around::gaussian) return far * about;
    if (diffusion_.around == Around::steps) {
      const auto count = static_cast<double>(diffusion_.steps.size());
      // Each of them in turn, from one that chance picks.
      const auto first =
          static_cast<std::size_t>(sim::Slots(key_, sim::Purpose::element, item).uniform(kStep) * count);
      return diffusion_.steps[(first + static_cast<std::size_t>(trial)) % diffusion_.steps.size()] +
             far * about;
    }
    // Edges too, beside what has none.
    return far * sim::unitCircle(slots.uniform(kSide));
  }

  std::optional<sim::ProposedElement> count(Outcome outcome, sim::Vec3 at_vx) {
    ++proposal_.trials[static_cast<std::size_t>(outcome)];
    if (view_.record_attempts) proposal_.attempts.push_back({around_.at_vx, at_vx, outcome, false});
    return std::nullopt;
  }

  /// `flush`: beside what was looked at from the site; else it is looked about where it would lie.
  std::optional<sim::ProposedElement> tryAt(std::int32_t shape, const LaidKind& kind, double scale,
                                            const LaidWay& way, Tilt tilt, bool flush) {
    const sim::Vec3 wanted_vx = site_.stance.placed(way.by);
    const bool seed = site_.beside == nullptr;
    const Scaled scaled{kind, scale};
    // Neighbours first: most trials end by them.
    if (flush) {
      if (const auto hindered = room_.hinders(scaled, way, seed)) return count(*hindered, wanted_vx);
    }
    const auto stance = room_.settle(scaled, way, diffusion_.ahead == Ahead::up && !flush);
    if (!stance) return count(Outcome::too_far, wanted_vx);
    if (!flush) {
      room_.look(*stance, nearby_vx() + (kind.flat ? kind.reach * scale : 0.0) + off_foot_ + kOnePlace_vx,
                 low_vx_, high_vx_);
      if (const auto hindered = room_.hinders(scaled, {}, seed)) return count(*hindered, stance->at_vx);
    }
    if (!room_.keepsApart(scaled, *stance, !flush || stance->at_vx == wanted_vx))
      return count(Outcome::blocked, wanted_vx);
    sim::ProposedElement laid;
    laid.element.shape = shape;
    laid.element.position_vx = stance->at_vx;
    laid.element.scale = scale;
    laid.element.exposure = static_cast<float>(senses_.exposure);
    poseOn(*stance, kind.rule->pose, senses_.light, tilt, laid.element);
    if (kind.flat) liftOnto(*stance, *kind.rule, laid.element);
    return room_.fits(laid, *stance) ? count(laid) : count(Outcome::blocked, stance->at_vx);
  }

  std::optional<sim::ProposedElement> count(const sim::ProposedElement& laid) {
    count(Outcome::grown, laid.element.position_vx);
    return laid;
  }

  const sim::SiteView& view_;
  const LayingSite& site_;
  const RuleSet& rules_;
  const Diffusion& diffusion_;
  const Surroundings& around_;
  const Senses& senses_;
  const sim::RandomKey& key_;
  std::int32_t first_shape_;
  sim::Proposal& proposal_;
  double radius_ = 0.0, off_foot_ = 0.0, low_vx_ = 0.0, high_vx_ = 0.05;
  bool looked_ = false;  ///< about the site, for all that may lie beside it
  LaidRoom room_;
};

}  // namespace

std::optional<sim::ProposedElement> layElement(const sim::SiteView& view, const LayingSite& site,
                                               const RuleSet& rules, const Surroundings& around,
                                               const Senses& senses, std::int32_t first_shape,
                                               const sim::RandomKey& key, sim::Proposal& proposal) {
  // Drawn by their shares, one after another, without putting back.
  sim::Slots draws(key, sim::Purpose::element_count);
  std::vector<std::pair<double, std::size_t>> left;  // share, and which
  for (std::size_t i = 0; i < rules.elements.size(); ++i) {
    const double share =
        evaluate(rules.elements[i].share, senses.circumstance, draws.uniform(static_cast<unsigned>(i)));
    if (share > 0.0) left.emplace_back(share, i);
  }
  Layer layer(view, site, rules, around, senses, first_shape, key, proposal);
  constexpr unsigned kMostElements = 64;
  for (unsigned draw = kMostElements; !left.empty(); ++draw) {
    double sum = 0.0;
    for (const auto& [share, i] : left) sum += share;
    double target = draws.uniform(draw) * sum;
    std::size_t picked = 0;
    while (picked + 1 < left.size() && target >= left[picked].first) target -= left[picked++].first;
    const std::size_t i = left[picked].second;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(picked));
    auto laid = layer.lay(first_shape + static_cast<std::int32_t>(i), static_cast<unsigned>(i));
    if (!laid) continue;
    for (sim::Attempt& attempt : proposal.attempts)
      attempt.taken = attempt.outcome == sim::Outcome::grown && attempt.to_vx == laid->element.position_vx;
    return laid;
  }
  return std::nullopt;
}

}  // namespace espalier::rules
