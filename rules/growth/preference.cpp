#include "rules/growth/preference.h"

#include <cmath>

#include "rules/growth/senses.h"
#include "sim/tile/tiling.h"

namespace espalier::rules {

Preference::Preference(const sim::SiteView& view, const RuleSet& rules, sim::Voxel site, int reach_vx)
    : view_(view), rules_(rules), site_(site), reach_vx_(reach_vx), around_(rules.prefer.senses.size()) {}

double Preference::scoreOf(sim::Vec3 to_vx, double proximity_vx) {
  const Prefer& prefer = rules_.prefer;
  double score =
      prefer.has_proximity ? prefer.weight * std::abs(proximity_vx - prefer.proximity.number) : 0.0;
  for (std::size_t i = 0; i < prefer.senses.size(); ++i)
    score += prefer.senses[i].weight * std::abs(readingOf(i, to_vx) - prefer.senses[i].at);
  return score;
}

double Preference::readingOf(std::size_t preference, sim::Vec3 at_vx) {
  const SenseSpec& sense = senseNamed(rules_, rules_.prefer.senses[preference].name);
  if (sense.measure == SenseSpec::Measure::height) return rules::readingOf(view_, sense, at_vx);
  const double within_vx = sense.within.number;
  std::optional<sim::Company>& around = around_[preference];
  if (!around)
    around.emplace(view_.world, whoseOf(view_, sense), site_, reach_vx_ + static_cast<int>(within_vx));
  const sim::Voxel at = sim::voxelAt(at_vx);
  if (sense.measure == SenseSpec::Measure::density) return around->density(at, within_vx);
  return rules::distanceRead(around->nearest(at, within_vx), at, sense, view_.world.frame());
}

}  // namespace espalier::rules
