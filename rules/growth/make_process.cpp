#include "rules/growth/make_process.h"

#include <fmt/format.h>

#include <algorithm>

#include "rules/growth/book_site.h"
#include "rules/growth/buds.h"
#include "rules/growth/colonization.h"
#include "rules/growth/diffusion.h"
#include "rules/growth/random_tree.h"
#include "rules/growth/rule_book.h"
#include "rules/growth/voxel_widths.h"
#include "sim/base/error.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

void requireOneWayOfGrowing(const RuleBook& book) {
  forEachSet(book.top(), [&](const RuleSet& set, const std::string& path) {
    if (set.propagate == book.top().propagate) return;
    throw sim::InputError(fmt::format(
        "rule set '{}', {}: it propagates otherwise than the plant's own set; expected the same for all of "
        "one plant, or a plant of its own",
        set.name, path));
  });
}

/// Greene's tree-structured random walk, from buds.
class WalkProcess final : public sim::Process {
 public:
  explicit WalkProcess(RuleBook book) : book_(std::move(book)), wants_(wantsOf(book_)) {
    forEachSet(book_.top(), [&](const RuleSet& set, const std::string&) {
      most_limbs_ = std::max(most_limbs_, static_cast<std::uint32_t>(set.random_tree.fork_max));
    });
  }

  sim::Wants wants() const override { return wants_; }
  sim::Plant seedling() const override { return seedlingOf(book_); }

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
                        const sim::RandomKey& key) const override {
    const RandomTree* grew_by = nullptr;
    sim::Proposal proposal =
        proposeByBook(view, site, key, book_, orderOf(view.plant, site.node) + (site.number == 0 ? 0 : 1),
                      [&](const RuleSet& rules, const Surroundings& around, const Senses& senses,
                          unsigned set, sim::Proposal& counts) {
                        grew_by = &rules.random_tree;
                        return stepBy(view, rules, around, senses, key, set, counts);
                      });
    if (proposal.outcome == Outcome::grown) proposal.sprouts = sproutsOf(*grew_by, key);
    const bool seed = view.plant.skeleton.parent[static_cast<std::size_t>(site.node)] == sim::kNoNode;
    // A seed that found no way may find one in the next iteration, by other trials; without it there is no
    // plant.
    proposal.retire =
        proposal.outcome != Outcome::resting && !(proposal.outcome == Outcome::no_trial && seed);
    return proposal;
  }

 private:
  bool forks() const { return most_limbs_ > 1; }

  std::optional<Candidate> stepBy(const sim::SiteView& view, const RuleSet& rules, const Surroundings& around,
                                  const Senses& senses, const sim::RandomKey& key, unsigned set,
                                  sim::Proposal& counts) const {
    if (rules.random_tree.fork_max > 1) return forkStep(view, rules, around, senses, key, set, counts);
    if (forks() && key.number > 0) return std::nullopt;  // a limb of a fork that this set does not make
    return bestStep(view, rules, around, senses, key, set, counts);
  }

  /// A tip of a plant that forks has a site for each limb that it may lay down.
  std::vector<sim::Sprout> sproutsOf(const RandomTree& grew_by, const sim::RandomKey& key) const {
    if (!forks()) {
      sim::Draws age(key, sim::Purpose::branch_age);
      return {{0, 1}, {1, age.whole(grew_by.branch_age_min, grew_by.branch_age_max)}};
    }
    std::vector<sim::Sprout> sprouts;
    for (std::uint32_t limb = 0; limb < most_limbs_; ++limb) sprouts.push_back({limb, 1});
    return sprouts;
  }

  RuleBook book_;
  sim::Wants wants_;
  std::uint32_t most_limbs_ = 1;
};

std::shared_ptr<const sim::Process> made(RuleBook book,
                                         std::shared_ptr<const sim::SceneSurface> surface = nullptr,
                                         sim::Voxel world_size = sim::Voxel(0)) {
  requireOneWayOfGrowing(book);
  if (book.top().propagate == Propagate::diffusion) {
    if (!surface)
      throw sim::InputError(
          fmt::format("rule set '{}' lays elements on a scene's surfaces; expected them with its world",
                      book.top().name));
    return makeDiffusion(std::move(book), std::move(surface), world_size);
  }
  if (book.top().propagate == Propagate::colonization) return makeColonization(std::move(book));
  return std::make_shared<WalkProcess>(std::move(book));
}

}  // namespace

std::shared_ptr<const sim::Process> makeProcess(std::shared_ptr<const RuleSet> rules, double voxel_m) {
  return made(RuleBook(inVoxelWidths(rules, voxel_m)));
}

std::shared_ptr<const sim::Process> makeProcess(std::shared_ptr<const RuleSet> rules, const sim::Frame& frame,
                                                std::shared_ptr<const sim::SceneSurface> surface) {
  const auto in_widths = inVoxelWidths(rules, frame.voxel_m);
  requireElementsFit(*in_widths, frame);
  return made(RuleBook(in_widths), std::move(surface), frame.size);
}

}  // namespace espalier::rules
