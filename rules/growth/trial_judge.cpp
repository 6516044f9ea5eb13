#include "rules/growth/trial_judge.h"

#include <cmath>

#include "sim/tile/tiling.h"

namespace espalier::rules {

using sim::Outcome;

Outcome judged(const RuleSet& rules, double proximity_vx) {
  if (proximity_vx > rules.require.proximity_max.number) return Outcome::too_far;
  if (proximity_vx < rules.require.proximity_min.number) return Outcome::too_near;
  return Outcome::grown;
}

TrialJudge::TrialJudge(const sim::SiteView& view, const RuleSet& rules, const Surroundings& around,
                       int reach_vx)
    : view_(view), rules_(rules), around_(around), reach_vx_(reach_vx) {
  if (!rules.prefer.senses.empty() || !rules.require.along.empty()) near_.resize(rules.senses.size());
}

Outcome TrialJudge::judged(sim::Vec3 to_vx, double proximity_vx) {
  const Outcome by_proximity = rules::judged(rules_, proximity_vx);
  if (by_proximity != Outcome::grown) return by_proximity;
  for (const SenseBounds& bounds : rules_.require.along) {
    for (const double share : {1.0, 0.5, 0.25, 0.75}) {  // the end says most
      const double reading = reads(bounds.name, glm::mix(around_.at_vx, to_vx, share));
      if (!(reading >= bounds.min && reading <= bounds.max)) return Outcome::unmet;
    }
  }
  return Outcome::grown;
}

double TrialJudge::scoreOf(sim::Vec3 to_vx, double proximity_vx) {
  const Prefer& prefer = rules_.prefer;
  double score =
      prefer.has_proximity ? prefer.weight * std::abs(proximity_vx - prefer.proximity.number) : 0.0;
  for (const SensePreference& by : prefer.senses)
    score += by.weight * std::abs(reads(by.name, to_vx) - by.at);
  return score;
}

double TrialJudge::reads(const std::string& name, sim::Vec3 at_vx) {
  const SenseSpec& sense = senseNamed(rules_, name);
  Near& near = near_[static_cast<std::size_t>(&sense - rules_.senses.data())];
  const double within_vx = sense.within.number;
  if (sense.measure == SenseSpec::Measure::height) return readingOf(view_, sense, at_vx);
  const double reach_vx = std::sqrt(3.0) * (reach_vx_ + 1) + within_vx;
  if (sense.of == kOfSurfaces) {
    if (!near.surfaces) near.surfaces.emplace(view_.commons, around_.at_vx, reach_vx);
    return distanceRead(near.surfaces->nearest(at_vx, within_vx), at_vx, sense, view_.world.frame());
  }
  if (sense.of == kOfLines) {
    if (!near.lines) near.lines.emplace(view_.commons, around_.at_vx, reach_vx);
    return distanceRead(near.lines->nearest(at_vx, within_vx), at_vx, sense, view_.world.frame());
  }
  if (!near.company) {
    near.company.emplace(view_.world, whoseOf(view_, sense), around_.voxel,
                         reach_vx_ + static_cast<int>(within_vx));
  }
  const sim::Voxel at = sim::voxelAt(at_vx);
  if (sense.measure == SenseSpec::Measure::density) return near.company->density(at, within_vx);
  const auto nearest = near.company->nearest(at, within_vx);
  return distanceRead(nearest ? std::optional(sim::Vec3(*nearest)) : std::nullopt, sim::Vec3(at), sense,
                      view_.world.frame());
}

}  // namespace espalier::rules
