#include "rules/growth/colonization.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "rules/front/lengths.h"
#include "rules/growth/book_site.h"
#include "rules/growth/front_bend.h"
#include "rules/growth/front_memory.h"
#include "rules/growth/front_step.h"
#include "rules/growth/shared_guide.h"
#include "sim/base/error.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

constexpr const char* kLengths = "front_lengths_vx";    // step, influence, kill; of each order
constexpr const char* kFarthest = "front_farthest_vx";  // attractor of each plant, if a field wants to know
constexpr double kShortestStep_vx = 0.1, kLongestStep_vx = 60.0;

class ColonizationProcess final : public sim::Process {
 public:
  explicit ColonizationProcess(RuleBook book)
      : book_(std::move(book)), wants_(wantsOf(book_)), front_(book_.top().colonization) {}

  sim::Wants wants() const override { return wants_; }
  sim::Plant seedling() const override { return seedlingOf(book_); }

  void begin(const sim::StandView& stand, sim::Columns& memory, sim::Commons& commons) const override;
  std::vector<sim::Site> due(const sim::StandView& stand, sim::Columns& memory,
                             sim::Commons& commons) const override;
  sim::Proposal propose(const sim::SiteView& view, const sim::Site& site,
                        const sim::RandomKey& key) const override;
  void settle(const sim::StandView& stand, std::span<const sim::Verdict> verdicts, sim::Columns& memory,
              sim::Commons& commons) const override;
  std::size_t alive(const sim::Columns& memory, const sim::Commons&) const override {
    return countFront(memory);
  }

 private:
  sim::Columns& home(sim::Commons& commons) const;
  OrderRules rulesIn(const sim::Columns& memory, int iteration, double reach) const;
  FrontLengths lengths(FrontLengths suitable, int order) const;
  Guidance guidance(const sim::StandView& stand, const sim::Columns& memory,
                    const sim::Commons& commons) const;

  RuleBook book_;
  sim::Wants wants_;
  Colonization front_;
};

sim::Columns& ColonizationProcess::home(sim::Commons& commons) const {
  if (const auto at = commons.find(attractorsNamed(front_.attractors)); at != commons.end())
    return at->second;
  throw sim::InputError(fmt::format("rule set '{}': there are no attractors '{}'; expected some of that name",
                                    book_.top().name, front_.attractors));
}

OrderRules ColonizationProcess::rulesIn(const sim::Columns& memory, int iteration, double reach) const {
  const auto& lengths = sim::column<double>(memory, kLengths);
  if (lengths.size() != 3 * (kTwig + 1)) throw sim::BrokenContract("a front without its lengths");
  OrderRules rules{FrontRules{}};
  for (std::size_t order = 0; order <= kTwig; ++order) {
    rules.of_order[order] = {lengths[3 * order],
                             reach * lengths[3 * order + 1],
                             reach * lengths[3 * order + 2],
                             front_.acts,
                             front_.onto,
                             front_.repeated,
                             iteration};
    try {
      requireSound(rules.of_order[order]);
    } catch (const sim::InputError& error) {  // they were sound when they were found
      throw sim::BrokenContract(error.what());
    }
  }
  return rules;
}

/// Of one order: those that it gives, and else the suitable ones.
FrontLengths ColonizationProcess::lengths(FrontLengths lengths, int order) const {
  const RuleSet& set = book_.ofOrder(order);
  const Colonization& given = set.colonization;
  if ((!given.step || !given.influence || !given.kill) && lengths.step == 0.0) {
    throw sim::InputError(fmt::format(
        "rule set '{}': its attractors '{}' are one, or lie in one place, so that no length follows from "
        "how far they are apart; expected colonization.step, influence and kill",
        set.name, front_.attractors));
  }
  if (given.step) lengths.step = given.step->number;
  if (given.influence) lengths.influence = given.influence->number;
  if (given.kill) lengths.kill = given.kill->number;
  requireSound(FrontRules{lengths.step, lengths.influence, lengths.kill});
  if (lengths.step < kShortestStep_vx || lengths.step > kLongestStep_vx) {
    throw sim::InputError(fmt::format(
        "rule set '{}': colonization.step is {:.3g} voxel widths{}; expected {} to {}, by another step or "
        "voxels of another size",
        set.name, lengths.step, given.step ? "" : ", as its attractors lie", kShortestStep_vx,
        kLongestStep_vx));
  }
  return lengths;
}

Guidance ColonizationProcess::guidance(const sim::StandView& stand, const sim::Columns& memory,
                                       const sim::Commons& commons) const {
  Guidance guidance;
  for (const std::string& name : front_.fields) {
    const auto at = commons.find(fieldNamed(name));
    if (at == commons.end()) {
      throw sim::InputError(fmt::format("rule set '{}': there is no field '{}'; expected one of that name",
                                        book_.top().name, name));
    }
    guidance.guides.push_back(guideIn(at->second));
  }
  if (guidance.guides.empty()) return guidance;
  guidance.farthest_vx = sim::column<double>(memory, kFarthest);
  if (guidance.farthest_vx.size() != stand.plants.size())
    throw sim::BrokenContract("a front that does not know how far its attractors are");
  guidance.normals =
      &sim::column<sim::Vec3>(commons.at(attractorsNamed(front_.attractors)), kAttractorNormal);
  return guidance;
}

std::span<const std::int32_t> wavesIn(const sim::Columns& attractors) {
  return sim::column<std::int32_t>(attractors, kAttractorWave);
}

void ColonizationProcess::begin(const sim::StandView& stand, sim::Columns& memory,
                                sim::Commons& commons) const {
  sim::Columns& columns = home(commons);
  const auto& places = sim::column<sim::Vec3>(columns, kAttractorPlace);
  const bool first = !holdsFront(columns);
  if (first) {
    Front fresh = frontOf(places);
    holdBack(fresh, wavesIn(columns));
    fresh.moved = {stand.iteration};
    const LentFront kept(columns, std::move(fresh));
  }
  LentFront lent(columns);
  // As if none were reached: what is suitable does not depend on who else begins.
  const double spacing = first ? spacingOf(lent.front.attractors) : spacingOf(sortedAttractors(places));
  const FrontLengths suitable = suitableLengths(spacing);
  auto& all = sim::column<double>(memory, kLengths);
  for (int order = 0; order <= kTwig; ++order) {
    const FrontLengths found = lengths(suitable, order);
    all.insert(all.end(), {found.step, found.influence, found.kill});
  }
  FrontMemory own;
  std::vector<NewNode> joining;
  std::vector<sim::Vec3> starts;
  for (std::size_t i = 0; i < stand.plants.size(); ++i) {
    const auto number = static_cast<std::int32_t>(lent.front.nodes.size() + i);
    own.active.push_back({number, static_cast<std::int32_t>(i), 0});
    starts.push_back(stand.plants[i].skeleton.position_vx.front());
    joining.push_back({starts.back()});
  }
  own.trunks = own.active;
  if (!front_.fields.empty()) {
    sim::column<double>(memory, kFarthest) = farthestOf(lent.front.attractors, starts);
    guidance(stand, memory, commons);  // says at once what is not there
  }
  join(lent.front, joining, rulesIn(memory, stand.iteration, reachIn(wavesIn(columns), 0)));
  keep(own, memory);
}

/// Sends those of a planting's nodes that meet others of it. Such a site has a number of its own.
void sendMeetings(FrontMemory& own, Front& front, const sim::StandView& stand) {
  const auto find = [&](std::int32_t number) -> const FrontNode* {
    const auto at = std::lower_bound(own.active.begin(), own.active.end(), number,
                                     [](const FrontNode& node, std::int32_t n) { return node.front < n; });
    return at == own.active.end() || at->front != number ? nullptr : &*at;
  };
  const Meetings all = takeMeetings(front);
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < all.from.size(); ++i) {
    const FrontNode *const from = find(all.from[i]), *const to = find(all.to[i]);
    if (from == nullptr) {  // another planting's
      front.links.meetings.from.push_back(all.from[i]);
      front.links.meetings.to.push_back(all.to[i]);
      continue;
    }
    if (to == nullptr) continue;
    number = i > 0 && all.from[i - 1] == all.from[i] ? number + 1 : 1;
    const auto placeOf = [&](const FrontNode& node) {
      return stand.plants[static_cast<std::size_t>(node.plant)]
          .skeleton.position_vx[static_cast<std::size_t>(node.node)];
    };
    const sim::Vec3 end_vx = placeOf(*to), way = end_vx - placeOf(*from);
    if (way == sim::Vec3(0.0)) continue;  // two seeds in one place
    const bool same = to->plant == from->plant;
    own.errands.push_back({*from, number, Gait::straight, false, glm::normalize(way), end_vx, kNobody,
                           same ? to->node : sim::kNoNode, same ? kNobody : to->front});
  }
}

/// Brings the next wave of attractors where nothing moves any more. Whether a planting's nodes have not met
/// yet what has come.
bool waveComes(FrontMemory& own, Front& front, std::span<const std::int32_t> waves, int iteration) {
  if (waves.empty()) return false;
  auto coming = comingWave(front, waves);
  if (coming && iteration > front.moved.front() + 1) {
    bringWave(front, waves, *coming);
    front.moved = {iteration};
    coming = comingWave(front, waves);
  }
  const std::int32_t come = coming.value_or(1 + *std::max_element(waves.begin(), waves.end())) - 1;
  return std::exchange(own.wave, std::max(own.wave, come)) < come;
}

void meetAgain(const FrontMemory& own, Front& front, const OrderRules& rules) {
  std::vector<std::int32_t> numbers;
  for (const FrontNode& node : own.active) numbers.push_back(node.front);
  meetAgain(front, numbers, rules);
}

std::vector<sim::Site> ColonizationProcess::due(const sim::StandView& stand, sim::Columns& memory,
                                                sim::Commons& commons) const {
  LentFront lent(home(commons));
  Front& front = lent.front;
  FrontMemory own = frontMemory(memory, stand);
  own.errands.clear();
  for (const FrontNode& node : own.active) requireNodes(front, {&node.front, 1});
  const std::span<const std::int32_t> waves = wavesIn(home(commons));
  const bool comes = waveComes(own, front, waves, stand.iteration);
  const OrderRules rules = rulesIn(memory, stand.iteration, reachIn(waves, own.wave));
  if (comes) meetAgain(own, front, rules);
  const bool more_come = comingWave(front, waves).has_value();
  std::vector<FrontNode> may = own.active;
  std::erase_if(may, [&](const FrontNode& node) {
    return !mayBranch(stand, book_, node, front.order[static_cast<std::size_t>(node.front)]);
  });
  std::vector<std::int32_t> numbers;
  for (const FrontNode& node : may) numbers.push_back(node.front);
  const std::vector<Way> ways = waysOf(front, numbers, rules);
  std::size_t kept = 0;  // of those that are still active, and of their ways
  auto way = ways.begin();
  for (const FrontNode& node : std::vector<FrontNode>(may)) {
    if (kept == numbers.size() || numbers[kept] != node.front) continue;
    may[kept++] = node;
    for (; way != ways.end() && way->node == node.front; ++way) {
      const auto gait = static_cast<Gait>(front.gait[static_cast<std::size_t>(node.front)]);
      aim(own.errands.emplace_back(Errand{node, way->number, gait}), front, *way, rules);
    }
  }
  may.resize(kept);
  sendMeetings(own, front, stand);
  // What nothing pulls now may be met, or pulled by what comes later.
  const bool keeps_all = more_come || front_.acts == Acts::on_all_neighbours;
  if (!keeps_all) own.active = std::move(may);
  std::erase_if(own.trunks, [&](const FrontNode& tip) {
    requireNodes(front, {&tip.front, 1});
    const Way up = trunkWay(front, tip.front, rules);
    if (up.node != kNobody)
      aim(own.errands.emplace_back(Errand{tip, 0, Gait::straight, true}), front, up, rules);
    return up.node == kNobody;
  });
  if (!own.errands.empty()) front.moved = {stand.iteration};
  // Nodes that pick an attractor wait for another to come to it. If none of those that share it goes
  // anywhere, they would wait for ever.
  if (stand.iteration > front.moved.front() + 1 && !more_come) own.active.clear();
  bend(own.errands, front, stand, book_, rules, guidance(stand, memory, commons));
  const auto place = [](const Errand& e) { return std::tuple(e.from.plant, e.from.node, e.number); };
  std::sort(own.errands.begin(), own.errands.end(),
            [&](const Errand& a, const Errand& b) { return place(a) < place(b); });
  keep(own, memory);
  std::vector<sim::Site> sites;
  for (const Errand& errand : own.errands) {
    const sim::Skeleton& skeleton = stand.plants[static_cast<std::size_t>(errand.from.plant)].skeleton;
    sites.push_back({errand.from.plant, errand.from.node, errand.number,
                     skeleton.position_vx[static_cast<std::size_t>(errand.from.node)]});
  }
  return sites;
}

sim::Proposal ColonizationProcess::propose(const sim::SiteView& view, const sim::Site& site,
                                           const sim::RandomKey& key) const {
  const Errand errand = errandOf(view.memory, site);
  bool limb_goes_on = true;
  view.kin.forEachChild(site.node, [&](sim::NodeId) { limb_goes_on = false; });
  sim::Proposal proposal = proposeByBook(
      view, site, key, book_, orderOf(view.plant, site.node) + (limb_goes_on ? 0 : 1),
      [&](const RuleSet& rules, const Surroundings& around, const Senses& senses, unsigned set,
          sim::Proposal& counts) { return frontStep(view, rules, around, senses, errand, key, set, counts); },
      errand.meets);
  proposal.retire = proposal.outcome != Outcome::resting;
  return proposal;
}

/// Whether a node did not do what it could: it will be sent the same way again.
bool waitsForNext(const sim::Verdict& verdict) {
  return verdict.outcome == Outcome::resting || verdict.outcome == Outcome::claimed;
}

/// Whether what a node goes for alone is not all that it could go for.
bool goesForOneOfMany(const FrontRules& rules) {
  return rules.onto || rules.repeated || rules.acts == Acts::on_every_node;
}

/// Whether a step aside served: where all of a node's attractors count, that shows when the step has joined.
bool cameNearer(const Errand& errand, sim::Vec3 at, const Front& front, const FrontRules& rules) {
  if (errand.attractor == kNobody) return true;
  if (!goesForOneOfMany(rules)) return false;
  const sim::Vec3 to =
      front.attractors.at(front.attractors.place[static_cast<std::size_t>(errand.attractor)]);
  return distance2(at, to) < distance2(front.nodes[static_cast<std::size_t>(errand.from.front)], to);
}

/// A node found no way, or may not grow. One that all its attractors pulled goes straight for one of them
/// next.
void failed(const Errand& errand, Outcome outcome, Front& front, const OrderRules& rules) {
  const bool no_way = outcome == Outcome::no_trial;
  const bool picks = rules.trunk().acts == Acts::on_every_node;
  if (errand.attractor == kNobody) {
    if (!no_way) giveUp(front, errand.from.front, rules);
  } else if (picks || (no_way && goesForOneOfMany(rules.trunk()))) {
    giveUpOne(front, errand.from.front, errand.attractor, rules);
  } else {
    giveUp(front, errand.from.front, rules);
  }
}

void ColonizationProcess::settle(const sim::StandView& stand, std::span<const sim::Verdict> verdicts,
                                 sim::Columns& memory, sim::Commons& commons) const {
  LentFront lent(home(commons));
  Front& front = lent.front;
  FrontMemory own = frontMemory(memory, stand);
  const OrderRules rules = rulesIn(memory, stand.iteration, reachIn(wavesIn(home(commons)), own.wave));
  if (own.errands.size() != verdicts.size())
    throw sim::BrokenContract("a front that was told of other sites");
  own.trunks.clear();
  std::vector<NewNode> joined;
  std::vector<std::pair<Errand, std::int32_t>>
      aside;                  // that came no nearer to what they went for, and whereto
  std::vector<Errand> again;  // that will meet others in the next iteration
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const sim::Verdict& verdict = verdicts[i];
    const Errand& errand = own.errands[i];
    if (verdict.node != sim::kNoNode) {
      const sim::Vec3 at = stand.plants[static_cast<std::size_t>(errand.from.plant)]
                               .skeleton.position_vx[static_cast<std::size_t>(verdict.node)];
      if (errand.isMeeting()) {
        joined.push_back({at, errand.from.front, true});
        continue;
      }
      if (!errand.trunk) taken(front, errand.attractor, rules);
      const FrontNode fresh{static_cast<std::int32_t>(front.nodes.size() + joined.size()), errand.from.plant,
                            verdict.node};
      joined.push_back({at, errand.from.front});
      own.active.push_back(fresh);
      if (errand.trunk) own.trunks.push_back(fresh);
      if (!errand.trunk && at != errand.end_vx && !cameNearer(errand, at, front, rules.trunk()))
        aside.push_back({errand, fresh.front});
    } else if (errand.isMeeting()) {
      if (waitsForNext(verdict)) again.push_back(errand);
    } else if (waitsForNext(verdict)) {
      if (errand.trunk) own.trunks.push_back(errand.from);
      if (!errand.trunk) keepForLater(front, errand.from.front);
    } else if (!errand.trunk) {
      failed(errand, verdict.outcome, front, rules);
    }
  }
  join(front, joined, rules);
  for (const Errand& errand : again) {
    const auto to = std::find_if(own.active.begin(), own.active.end(), [&](const FrontNode& node) {
      return errand.meets_another != kNobody ? node.front == errand.meets_another
                                             : node.plant == errand.from.plant && node.node == errand.meets;
    });
    if (to == own.active.end()) continue;
    front.links.meetings.from.push_back(errand.from.front);
    front.links.meetings.to.push_back(to->front);
  }
  for (const auto& [errand, to] : aside) {
    const auto n = static_cast<std::size_t>(errand.from.front);
    if (goesForOneOfMany(rules.trunk())) {
      giveUpOne(front, errand.from.front, errand.attractor, rules);
    } else if (front.pulls.count[n] == front.tried[n]) {
      handOver(front, errand.from.front, to, rules);
    }
  }
  own.errands.clear();
  keep(own, memory);
}

}  // namespace

std::shared_ptr<const sim::Process> makeColonization(RuleBook book) {
  return std::make_shared<ColonizationProcess>(std::move(book));
}

}  // namespace espalier::rules
