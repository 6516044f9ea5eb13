#pragma once
#include <optional>
#include <vector>

#include "rules/language/rule_set.h"
#include "sim/grow/process.h"
#include "sim/sense/company.h"

namespace espalier::rules {

/// What a rule set prefers, asked about many trials of one site. The view and the rules must outlive it.
class Preference {
 public:
  /// Of trials that end within `reach_vx` of the site along any axis.
  Preference(const sim::SiteView& view, const RuleSet& rules, sim::Voxel site, int reach_vx);

  /// How far a trial is from what is preferred; the least wins.
  double scoreOf(sim::Vec3 to_vx, double proximity_vx);

 private:
  double readingOf(std::size_t preference, sim::Vec3 at_vx);

  const sim::SiteView& view_;
  const RuleSet& rules_;
  sim::Voxel site_;
  int reach_vx_;
  std::vector<std::optional<sim::Company>> around_;  // by preference: gathered for the first trial that asks
};

}  // namespace espalier::rules
