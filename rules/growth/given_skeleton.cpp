#include "rules/growth/given_skeleton.h"

#include <algorithm>

#include "rules/growth/book_site.h"
#include "rules/growth/elements.h"
#include "rules/growth/voxel_widths.h"
#include "sim/base/error.h"
#include "sim/sense/proximity.h"
#include "sim/tile/tiling.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

constexpr const char* kLeft = "given_left";  // of each plant: nodes that are still to be placed

class GivenProcess final : public sim::Process {
 public:
  GivenProcess(RuleBook book, std::vector<ArrangedTree> trees)
      : book_(std::move(book)), wants_(wantsOf(book_)), trees_(std::move(trees)) {}

  sim::Wants wants() const override { return wants_; }
  sim::Plant seedling() const override {
    sim::Plant plant = seedlingOf(book_);
    if (haveRadii()) plant.skeleton.columns[sim::kRadiusColumn];
    return plant;
  }
  void begin(const sim::StandView& stand, sim::Columns& memory, sim::Commons&) const override {
    requireTrees(stand);
    auto& left = sim::column<std::int64_t>(memory, kLeft);
    for (const ArrangedTree& tree : trees_) left.push_back(tree.size() - 1);
  }
  std::vector<sim::Site> due(const sim::StandView& stand, sim::Columns& memory, sim::Commons&) const override;
  sim::Proposal propose(const sim::SiteView& view, const sim::Site& site,
                        const sim::RandomKey& key) const override;
  void settle(const sim::StandView&, std::span<const sim::Verdict> verdicts, sim::Columns& memory,
              sim::Commons&) const override {
    auto& left = sim::column<std::int64_t>(memory, kLeft);
    for (const sim::Verdict& verdict : verdicts) left[static_cast<std::size_t>(verdict.site.plant)] -= 1;
  }
  bool goesOn(const sim::StandView& stand, const sim::Columns&) const override {
    for (std::size_t i = 0; i < trees_.size(); ++i) {
      if (nextOf(stand, i) >= 0) return true;
    }
    return false;
  }
  std::size_t alive(const sim::Columns& memory, const sim::Commons&) const override {
    std::size_t sum = 0;
    for (const std::int64_t left : sim::column<std::int64_t>(memory, kLeft)) {
      if (left < 0) throw sim::BrokenContract("a given skeleton of which more stands than there is");
      sum += static_cast<std::size_t>(left);
    }
    return sum;
  }

 private:
  bool haveRadii() const { return !trees_.empty() && !trees_.front().tree.radius_vx.empty(); }

  void requireTrees(const sim::StandView& stand) const {
    if (stand.plants.size() != trees_.size())
      throw sim::BrokenContract("given skeletons, and as many plants as there are not");
  }

  /// The node of a tree that is placed next, if it is due; else -1.
  std::int32_t nextOf(const sim::StandView& stand, std::size_t plant) const {
    const ArrangedTree& tree = trees_[plant];
    const std::int32_t next = stand.plants[plant].skeleton.size();
    return next < tree.size() && tree.iteration[static_cast<std::size_t>(next)] <= stand.iteration ? next
                                                                                                   : -1;
  }

  RuleBook book_;
  sim::Wants wants_;
  std::vector<ArrangedTree> trees_;
};

std::vector<sim::Site> GivenProcess::due(const sim::StandView& stand, sim::Columns& memory,
                                         sim::Commons&) const {
  requireTrees(stand);
  const auto& left = sim::column<std::int64_t>(memory, kLeft);
  std::vector<sim::Site> sites;
  for (std::size_t i = 0; i < trees_.size(); ++i) {
    const ArrangedTree& tree = trees_[i];
    const sim::Skeleton& stands = stand.plants[i].skeleton;
    if (left.size() != trees_.size() || left[i] != tree.size() - stands.size())
      throw sim::BrokenContract("a given skeleton of which as much stands as it does not remember");
    const std::int32_t next = nextOf(stand, i);
    if (next < 0) continue;
    for (auto n = static_cast<std::size_t>(next);
         n < tree.wave.size() && tree.wave[n] == tree.wave[static_cast<std::size_t>(next)]; ++n) {
      const sim::NodeId parent = tree.tree.parent[n];
      if (parent >= stands.size()) throw sim::BrokenContract("a given node before its parent");
      sites.push_back({static_cast<std::int32_t>(i), parent, static_cast<std::uint32_t>(tree.number[n]),
                       stands.position_vx[static_cast<std::size_t>(parent)]});
    }
  }
  return sites;
}

/// Whether a set dresses what stands in that light.
bool dresses(const RuleSet* set, const Vigour& light) {
  return set != nullptr && light.exposure >= set->require.exposure_min &&
         light.exposure <= set->require.exposure_max;
}

sim::Proposal GivenProcess::propose(const sim::SiteView& view, const sim::Site& site,
                                    const sim::RandomKey& key) const {
  const ArrangedTree& tree = trees_[static_cast<std::size_t>(site.plant)];
  // Nodes of a wave are in the order of their sites.
  const auto first = static_cast<std::size_t>(view.plant.skeleton.size());
  if (first >= tree.wave.size())
    throw sim::BrokenContract("a given skeleton was asked for more than there is");
  const auto last = std::upper_bound(tree.wave.begin() + static_cast<std::ptrdiff_t>(first), tree.wave.end(),
                                     tree.wave[first]) -
                    tree.wave.begin();
  std::size_t node = first;
  for (auto high = static_cast<std::size_t>(last); node < high;) {
    const std::size_t middle = node + (high - node) / 2;
    if (std::pair(tree.tree.parent[middle], tree.number[middle]) <
        std::pair(site.node, static_cast<std::int32_t>(site.number))) {
      node = middle + 1;
    } else {
      high = middle;
    }
  }
  if (node == static_cast<std::size_t>(last) || tree.tree.parent[node] != site.node ||
      tree.number[node] != static_cast<std::int32_t>(site.number))
    throw sim::BrokenContract("a given skeleton was asked for a node that is not due");
  const sim::Vec3 to_vx = tree.tree.position_vx[node];
  const int order = tree.order[node];

  sim::Proposal proposal{.outcome = Outcome::grown};
  std::vector<sim::Voxel> passes, takes;
  sim::tileSegment(site.at_vx, to_vx, passes);
  sim::fit(view.world, passes, {}, sim::Passage::through, sim::numberOf(view.world, view.plant), takes);
  const sim::Voxel root = sim::voxelAt(view.plant.skeleton.position_vx.front());
  const bool meets = std::any_of(passes.begin(), passes.end(), [&](sim::Voxel v) {
    return !sim::besides(v, root) && isScene(view.world, v);
  });
  ++proposal.trials[static_cast<std::size_t>(meets ? Outcome::blocked : Outcome::grown)];
  if (view.record_attempts)
    proposal.attempts.push_back({site.at_vx, to_vx, meets ? Outcome::blocked : Outcome::grown, true});

  const RuleSet* const set = book_.first(view.world, sim::voxelAt(site.at_vx), order);
  const Exposure seen = seenAt(view);
  const Vigour light = vigourOf(seen, set != nullptr ? *set : book_.ofOrder(order));
  if (dresses(set, light)) {
    const Surroundings around = lookAround(view, site);
    proposal.elements = proposeElements(view, site, *set, around, sense(view, around, light, *set), to_vx,
                                        passes, book_.firstShape(*set), key);
  }
  proposal.segment = {to_vx, std::move(takes), sim::Passage::through,
                      quantitiesOf(view, book_, site, to_vx, seen, light.exposure, order,
                                   sim::meanProximity(view.world, passes),
                                   haveRadii() ? std::optional(tree.tree.radius_vx[node]) : std::nullopt)};
  return proposal;
}

}  // namespace

bool standsIn(sim::Voxel size, sim::Vec3 at_vx) {
  return sim::holds(size, at_vx) && sim::contains(size, sim::tilePoint(at_vx));
}

std::shared_ptr<const sim::Process> makeGivenSkeleton(const std::shared_ptr<const RuleSet>& rules,
                                                      const sim::Frame& frame, std::vector<GivenTree> trees,
                                                      int iterations) {
  const auto in_widths = inVoxelWidths(rules, frame.voxel_m);
  requireElementsFit(*in_widths, frame);
  for (const GivenTree& tree : trees) {
    for (const sim::Vec3 at_vx : tree.position_vx) {
      if (!standsIn(frame.size, at_vx)) throw sim::BrokenContract("a given node outside the world");
    }
  }
  return std::make_shared<GivenProcess>(RuleBook(in_widths), arranged(std::move(trees), iterations));
}

}  // namespace espalier::rules
