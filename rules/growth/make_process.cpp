#include "rules/growth/make_process.h"

#include <algorithm>
#include <optional>

#include "rules/growth/buds.h"
#include "rules/growth/elements.h"
#include "rules/growth/random_tree.h"
#include "rules/growth/rule_book.h"
#include "rules/growth/voxel_widths.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

class BookProcess final : public sim::Process {
 public:
  explicit BookProcess(RuleBook book) : book_(std::move(book)) {
    forEachSet(book_.top(), [&](const RuleSet& set, const std::string&) {
      sky_table_ = sky_table_ || set.bias.brightest == Brightest::table;
    });
  }

  sim::Wants wants() const override { return {.light = true, .sky_table = sky_table_}; }

  sim::Plant seedling() const override {
    sim::Plant plant;
    plant.shapes = book_.shapes();
    plant.stem_colour = book_.top().stem_colour;
    plant.stem_radius_vx = book_.top().stem_radius.number;
    for (const char* name : {"exposure", "proximity_vx", "sky_exposure", "sun_exposure"})
      plant.skeleton.columns[name];
    return plant;
  }

  void begin(const sim::StandView& stand, sim::Columns& memory, sim::Commons&) const override {
    beginBuds(stand, memory);
  }
  std::vector<sim::Site> due(const sim::StandView& stand, sim::Columns& memory,
                             sim::Commons&) const override {
    return dueBuds(stand, memory);
  }
  void settle(const sim::StandView& stand, std::span<const sim::Verdict> verdicts, sim::Columns& memory,
              sim::Commons&) const override {
    settleBuds(stand, verdicts, memory);
  }
  std::size_t alive(const sim::Columns& memory, const sim::Commons&) const override {
    return countBuds(memory);
  }

  sim::Proposal propose(const sim::SiteView& view, const sim::Site& site,
                        const sim::RandomKey& key) const override;

 private:
  /// Why a set does not grow here; grown if it does, and then the proposal says what. `set` numbers the sets
  /// that one site tries, from 0.
  Outcome tryToGrow(const sim::SiteView& view, const RuleSet& rules, const sim::Site& site,
                    const sim::RandomKey& key, unsigned set, sim::Proposal& proposal) const;

  RuleBook book_;
  bool sky_table_ = false;
};

Outcome BookProcess::tryToGrow(const sim::SiteView& view, const RuleSet& rules, const sim::Site& site,
                               const sim::RandomKey& key, unsigned set, sim::Proposal& proposal) const {
  const Exposure seen = exposureOf(*view.light);
  const Vigour light = vigourOf(seen, rules);
  if (light.exposure < rules.require.exposure_min) return Outcome::too_dark;
  if (light.exposure > rules.require.exposure_max) return Outcome::too_bright;
  const double chance = sim::Slots(key, sim::Purpose::rate, set).uniform(0);
  if (chance * std::max(1.0, rules.light.boost) >= light.vigour) return Outcome::resting;

  const Surroundings around = lookAround(view, site);
  const Senses senses = sense(view, around, light, rules);
  std::optional<Candidate> best;
  switch (rules.propagate) {
    case Propagate::random_tree:
      best = bestTrial(view, rules, around, senses, key, set, proposal);
      break;
  }
  if (!best) return Outcome::no_trial;
  proposal.elements =
      proposeElements(view, rules, around, senses, best->to_vx, best->passes, book_.firstShape(rules), key);
  proposal.segment = {best->to_vx,
                      std::move(best->takes),
                      best->passage,
                      // exposure, proximity_vx, sky_exposure, sun_exposure: in the order of their names
                      {static_cast<float>(senses.exposure), static_cast<float>(best->proximity_vx),
                       static_cast<float>(seen.sky), static_cast<float>(seen.sun)}};
  sim::Draws age(key, sim::Purpose::branch_age);
  proposal.sprouts = {{0, 1},
                      {1, age.whole(rules.random_tree.branch_age_min, rules.random_tree.branch_age_max)}};
  return Outcome::grown;
}

sim::Proposal BookProcess::propose(const sim::SiteView& view, const sim::Site& site,
                                   const sim::RandomKey& key) const {
  sim::Proposal proposal;
  const sim::Voxel at = sim::voxelAt(site.at_vx);
  const RuleSet* rules = book_.first(view.world, at);
  proposal.outcome = Outcome::forbidden;
  if (rules == nullptr) return proposal;

  for (unsigned set = 0; rules != nullptr; ++set, rules = book_.next(*rules, view.world, at)) {
    const Outcome outcome = tryToGrow(view, *rules, site, key, set, proposal);
    // What is told of a site that did not grow is why its first set failed, unless a later one got as far as
    // trials.
    if (set == 0 || outcome == Outcome::no_trial || outcome == Outcome::grown || outcome == Outcome::resting)
      proposal.outcome = outcome;
    if (outcome == Outcome::grown || outcome == Outcome::resting) break;
  }
  const bool seed = view.plant.skeleton.parent[static_cast<std::size_t>(site.node)] == sim::kNoNode;
  // A seed that found no way may find one in the next iteration, by other trials; without it there is no
  // plant.
  proposal.retire = proposal.outcome != Outcome::resting && !(proposal.outcome == Outcome::no_trial && seed);
  return proposal;
}

}  // namespace

std::shared_ptr<const sim::Process> makeProcess(std::shared_ptr<const RuleSet> rules, double voxel_m) {
  return std::make_shared<BookProcess>(RuleBook(inVoxelWidths(rules, voxel_m)));
}

std::shared_ptr<const sim::Process> makeProcess(std::shared_ptr<const RuleSet> rules,
                                                const sim::Frame& frame) {
  const auto in_widths = inVoxelWidths(rules, frame.voxel_m);
  requireElementsFit(*in_widths, frame);
  return std::make_shared<BookProcess>(RuleBook(in_widths));
}

}  // namespace espalier::rules
