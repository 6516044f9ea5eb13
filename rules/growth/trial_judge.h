#pragma once
#include <optional>
#include <vector>

#include "rules/growth/scene_lines.h"
#include "rules/growth/scene_surfaces.h"
#include "rules/growth/senses.h"
#include "sim/sense/company.h"

namespace espalier::rules {

/// What the rules say to a segment that has room, by its proximity.
sim::Outcome judged(const RuleSet& rules, double proximity_vx);

/// What a rule set requires of trials and prefers, asked about many trials of one site. The view,
/// the rules and the surroundings must outlive it.
class TrialJudge {
 public:
  /// Of trials that end within `reach_vx` of the site along any axis.
  TrialJudge(const sim::SiteView& view, const RuleSet& rules, const Surroundings& around, int reach_vx);

  /// What the rules say to a segment that has room.
  sim::Outcome judged(sim::Vec3 to_vx, double proximity_vx);
  /// How far such a segment is from what is preferred; the least wins.
  double scoreOf(sim::Vec3 to_vx, double proximity_vx);

 private:
  double reads(const std::string& sense, sim::Vec3 at_vx);

  /// What one sense asks about, gathered for the first trial that asks.
  struct Near {
    std::optional<sim::Company> company;
    std::optional<LinesNear> lines;
    std::optional<SurfacesNear> surfaces;
  };

  const sim::SiteView& view_;
  const RuleSet& rules_;
  const Surroundings& around_;
  int reach_vx_;
  std::vector<Near> near_;  // by sense
};

}  // namespace espalier::rules
