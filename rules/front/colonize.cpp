#include "rules/front/colonize.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "sim/base/error.h"
#include "sim/base/stop.h"

namespace espalier::rules {
namespace {

void requireFinite(std::span<const sim::Vec3> places, const char* what) {
  if (places.empty()) throw sim::InputError(fmt::format("there is no {}; expected at least one", what));
  for (const sim::Vec3& at : places) {
    if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z))
      throw sim::InputError(fmt::format("a place of the {}s is no number", what));
  }
}

}  // namespace

Colony colonize(std::span<const sim::Vec3> attractors, std::span<const sim::Vec3> starts, FrontRules rules,
                int iterations, std::span<const std::int32_t> waves) {
  requireSound(rules);
  requireFinite(attractors, "attractor");
  requireFinite(starts, "start");
  if (!waves.empty() && waves.size() != attractors.size())
    throw sim::InputError(
        fmt::format("{} waves of {} attractors; expected one of each", waves.size(), attractors.size()));
  Front front = frontOf(attractors);
  holdBack(front, waves);
  Colony colony;
  colony.parent.assign(starts.size(), kNobody);
  colony.born.assign(starts.size(), 0);
  colony.joins.assign(starts.size(), kNobody);
  const FrontRules last = rules;
  const auto reachTo = [&](std::int32_t wave) {
    rules.influence = reachIn(waves, wave) * last.influence;
    rules.kill = reachIn(waves, wave) * last.kill;
  };
  reachTo(0);
  std::vector<NewNode> joining;
  for (const sim::Vec3& start : starts) joining.push_back({start});
  join(front, joining, rules);
  std::vector<std::int32_t> active(starts.size()), trunks(starts.size());
  std::iota(active.begin(), active.end(), 0);
  std::iota(trunks.begin(), trunks.end(), 0);
  std::vector<std::int32_t> all = active;  // on which something may act, in another wave too
  const auto add = [&](NewNode node, std::int32_t joins) {
    joining.push_back(node);
    colony.parent.push_back(node.from);
    colony.born.push_back(colony.iterations);
    colony.joins.push_back(joins);
  };
  for (; colony.iterations < iterations; ++colony.iterations) {
    sim::throwIfStopped();
    rules.iteration = colony.iterations;
    std::vector<Way> ways = waysOf(front, active, rules);
    const std::size_t pulled = ways.size();
    std::erase_if(trunks, [&](std::int32_t tip) {
      const Way way = trunkWay(front, tip, rules);
      if (way.node != kNobody) ways.push_back(way);
      return way.node == kNobody;
    });
    const Meetings meetings = takeMeetings(front);
    if (ways.empty() && meetings.from.empty()) {
      const auto wave = comingWave(front, waves);
      if (!wave) break;
      bringWave(front, waves, *wave);
      reachTo(*wave);
      active = all;
      meetAgain(front, active, rules);
      continue;
    }
    joining.clear();
    std::vector<Goal> goals;
    for (const Way& way : ways) goals.push_back(goalOf(front, way, way.direction, rules));
    for (std::size_t i = 0; i < ways.size(); ++i) {
      if (!ways[i].trunk) taken(front, goals[i].attractor, rules);
      const auto node = static_cast<std::int32_t>(colony.parent.size());
      add({goals[i].end, ways[i].node}, kNobody);
      active.push_back(node);
      all.push_back(node);
      if (i >= pulled) trunks[i - pulled] = node;
    }
    for (std::size_t i = 0; i < meetings.from.size(); ++i)
      add({front.nodes[asIndex(meetings.to[i])], meetings.from[i], true}, meetings.to[i]);
    join(front, joining, rules);
  }
  colony.position = std::move(front.nodes);
  colony.fates = fatesOf(front.attractors.fate);
  return colony;
}

}  // namespace espalier::rules
