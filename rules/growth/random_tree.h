#pragma once
#include <optional>

#include "rules/growth/senses.h"
#include "rules/growth/ways.h"
#include "rules/language/rule_set.h"
#include "sim/grow/process.h"

/// Greene's tree-structured random walk (1989, sections 3 and 4): a site makes randomly perturbed trials of a
/// segment, rejects those that do not meet `require`, and takes the one that `prefer` ranks first.
///
/// Where Greene's text leaves it open: trials beyond trials.min, made where none was good yet, wander farther
/// and farther, up to twice the angle. A trial that would take no free voxel is blocked: it folds back into
/// its own limb, and could for ever.
namespace espalier::rules {

/// A trial that met the rules.
struct Candidate {
  sim::Vec3 to_vx{0.0};
  std::vector<sim::Voxel> passes;               ///< that the segment crosses
  std::vector<sim::Voxel> takes;                ///< the free ones of them
  sim::Passage passage = sim::Passage::around;  ///< as `require.clear` says
  double proximity_vx = 0.0;                    ///< mean distance from the scene along it
};

/// The voxels that segments of a set may reach along any axis.
int reachOf(const Ways& ways);

/// How hard a site tries.
struct Trials {
  int first = 0;  ///< the first trial's number
  int min = 1;    ///< before the best one is taken, where rules prefer one
  int max = 1;    ///< before it gives up
  sim::Passage passage = sim::Passage::around;
};

/// The best of a site's trials under one rule set, if there is a good one; counts them all in `proposal`, and
/// records each once if the view says so. Trials are felt along many at a time; they count as if they were
/// made one by one.
std::optional<Candidate> bestTrial(const sim::SiteView& view, const RuleSet& rules,
                                   const Surroundings& around, const Ways& ways, const Trials& trials,
                                   sim::Proposal& proposal);

/// Greene's walk: the same for a tip or a side under one rule set. `set` numbers the rule sets that one site
/// tries, from 0.
std::optional<Candidate> bestStep(const sim::SiteView& view, const RuleSet& rules, const Surroundings& around,
                                  const Senses& senses, const sim::RandomKey& key, unsigned set,
                                  sim::Proposal& proposal);

/// One of the segments that a tip lays at once, as the rule set's `fork` says: that of the site's number,
/// each number a site of its own. All of a tip's sites make the same trials, and take the best of them, then
/// the best of those that lie far enough from it, and so on; none grows where there are fewer than the least.
std::optional<Candidate> forkStep(const sim::SiteView& view, const RuleSet& rules, const Surroundings& around,
                                  const Senses& senses, const sim::RandomKey& key, unsigned set,
                                  sim::Proposal& proposal);

}  // namespace espalier::rules
