#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rules/front/front.h"

namespace espalier::rules {

void holdBack(Front& front, std::span<const std::int32_t> waves) {
  for (std::size_t number = 0; number < waves.size(); ++number) {
    if (waves[number] > 0)
      end(front.attractors, front.attractors.place.at(number), Fate::later, -1, front.nodes, front.pulls);
  }
}

std::optional<std::int32_t> comingWave(const Front& front, std::span<const std::int32_t> waves) {
  std::optional<std::int32_t> first;
  for (std::size_t number = 0; number < waves.size(); ++number) {
    const auto at = asIndex(front.attractors.place.at(number));
    if (front.attractors.fate[at] != static_cast<std::int32_t>(Fate::later)) continue;
    first = std::min(first.value_or(waves[number]), waves[number]);
  }
  return first;
}

void bringWave(Front& front, std::span<const std::int32_t> waves, std::int32_t wave) {
  for (std::size_t number = 0; number < waves.size(); ++number) {
    const std::int32_t at = front.attractors.place.at(number);
    if (waves[number] == wave && front.attractors.fate[asIndex(at)] == static_cast<std::int32_t>(Fate::later))
      bring(front.attractors, at);
  }
}

double reachIn(std::span<const std::int32_t> waves, std::int32_t wave) {
  if (waves.empty()) return 1.0;
  return std::ldexp(1.0, std::max(0, *std::max_element(waves.begin(), waves.end()) - wave));
}

Meetings takeMeetings(Front& front) {
  const Meetings all = std::exchange(front.links.meetings, {});
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::size_t i = 0; i < all.from.size(); ++i) pairs.emplace_back(all.from[i], all.to[i]);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Meetings sorted;
  for (const auto& [from, to] : pairs) {
    sorted.from.push_back(from);
    sorted.to.push_back(to);
  }
  return sorted;
}

Fates fatesOf(std::span<const std::int32_t> fate) {
  Fates fates;
  for (const std::int32_t one : fate) {
    switch (static_cast<Fate>(one)) {
      case Fate::waiting:
      case Fate::later:
        ++fates.waiting;
        break;
      case Fate::reached:
        ++fates.reached;
        break;
      case Fate::given_up:
        ++fates.given_up;
        break;
      case Fate::taken:
        ++fates.taken;
        break;
    }
  }
  return fates;
}

std::string endingOf(const Fates& fates, bool moves) {
  const std::size_t came = fates.reached + fates.taken, all = came + fates.given_up + fates.waiting;
  if (came == all) return "all attractors were reached";
  if (fates.waiting == 0)
    return fmt::format("{} of {} attractors were reached; no way led to the others", came, all);
  if (moves) return fmt::format("the iterations ended while {} of {} attractors wait", fates.waiting, all);
  return fmt::format("no attractor is in reach any more; {} of {} wait", fates.waiting, all);
}

}  // namespace espalier::rules
