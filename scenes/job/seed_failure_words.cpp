#include "scenes/job/seed_failure_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "rules/growth/diffusion.h"
#include "scenes/problem.h"
#include "sim/base/counted.h"

namespace espalier::scenes {
namespace {

using Plant = Report::Growth::Plant;
using sim::Outcome;

/// Who asks: "the rules", or one of the sets that they lead to.
std::string nameOf(const SeedFailure::Set& set) {
  return set.path.empty() ? "the rules ask" : inQuotes(set.path) + " asks";
}

/// Two shares that differ, with as many decimals as show it.
std::pair<std::string, std::string> apart(double seen, double wanted) {
  for (int digits = 2; digits < 6; ++digits) {
    auto pair = std::pair(fmt::format("{:.{}f}", seen, digits), fmt::format("{:.{}f}", wanted, digits));
    if (pair.first != pair.second) return pair;
  }
  return {fmt::format("{:.8g}", seen), fmt::format("{:.8g}", wanted)};
}

std::string ofLight(const SeedFailure& failure, Outcome reason) {
  const bool dark = reason == Outcome::too_dark;
  if (failure.sets.empty()) return dark ? "it is too dark" : "it is too bright";
  const SeedFailure::Set& first = failure.sets.front();
  const double limit = dark ? first.exposure_min : first.exposure_max;
  const auto [seen, wanted] = apart(first.exposure, limit);
  const char* at_most = dark ? "at least" : "at most";
  if (first.outcome != reason) {  // other plants changed it later
    return fmt::format(
        "the seed saw {} of the light at first, and {} for {} {}; what grew around it took too much", seen,
        nameOf(first), at_most, wanted);
  }
  std::string text =
      fmt::format("the seed sees {} of the light; {} for {} {}", seen, nameOf(first), at_most, wanted);
  for (std::size_t i = 1; i < std::min<std::size_t>(3, failure.sets.size()); ++i) {
    const SeedFailure::Set& set = failure.sets[i];
    if (set.outcome == Outcome::no_trial) continue;
    const bool still_dark = set.outcome == Outcome::too_dark;
    const auto [sees, wants] = apart(set.exposure, still_dark ? set.exposure_min : set.exposure_max);
    text += fmt::format(", {} for {} {}", nameOf(set), still_dark ? "at least" : "at most", wants);
    if (sees != seen) text += fmt::format(" of the {} that it counts", sees);
  }
  return text;
}

/// In the unit of the rule.
std::string lengthOf(double vx, bool metres, double voxel_m) {
  if (metres && vx * voxel_m < 1.0) return fmt::format("{:.3g} cm", vx * voxel_m * 100.0);
  if (metres) return fmt::format("{:.3g} m", vx * voxel_m);
  return fmt::format("{:.3g}", vx);
}

std::string limitOf(RuleLength limit, double voxel_m) {
  if (limit.metres) return lengthOf(limit.vx, true, voxel_m);
  return fmt::format("{:.3g} voxel width{}", limit.vx, limit.vx == 1.0 ? "" : "s");
}

std::string wallOf(const SeedFailure& failure, RuleLength limit) {
  if (!failure.wall_vx) {
    return fmt::format("the nearest wall is more than {} away",
                       lengthOf(kFarthestWall, limit.metres, failure.voxel_m));
  }
  return fmt::format("the nearest wall is {} away",
                     lengthOf(*failure.wall_vx, limit.metres, failure.voxel_m));
}

/// The set whose trials failed: the first for which the light was right.
const SeedFailure::Set* triedOf(const SeedFailure& failure) {
  for (const SeedFailure::Set& set : failure.sets) {
    if (set.outcome == Outcome::no_trial) return &set;
  }
  return failure.sets.empty() ? nullptr : &failure.sets.front();
}

constexpr std::array<std::pair<Outcome, const char*>, 5> kRejections{
    {{Outcome::blocked, "blocked"},
     {Outcome::too_far, "too far from the scene"},
     {Outcome::too_near, "too near to it"},
     {Outcome::out_of_world, "out of the world"},
     {Outcome::unmet, "along which require.along is not met"}}};

/// " (of 900 trials 700 too far from the scene, 200 blocked)" where there was more than one reason.
std::string others(const sim::OutcomeCounts& trials) {
  std::vector<std::pair<std::uint64_t, const char*>> told;
  std::uint64_t all = 0;
  for (const auto& [outcome, words] : kRejections) {
    const std::uint64_t times = sim::timesOf(trials, outcome);
    all += times;
    if (times > 0) told.emplace_back(times, words);
  }
  if (told.size() < 2) return "";
  std::stable_sort(told.begin(), told.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text = fmt::format(" (of {} trials", all);
  for (std::size_t i = 0; i < told.size(); ++i)
    text += fmt::format("{} {} {}", i == 0 ? "" : ",", told[i].first, told[i].second);
  return text + ")";
}

std::string ofLaying(const SeedFailure& failure) {
  if (failure.reason == Outcome::too_far && sim::timesOf(failure.tally.sites, Outcome::too_far) > 0) {
    return fmt::format(
        "no surface on which it may lay something lies within {} of the seed; expected a seed nearer to one, "
        "or other regions",
        limitOf({rules::kSeedReach_vx, true}, failure.voxel_m));
  }
  return fmt::format(
      "no element had room there: {} trials stood in the way of something, {} hung over an edge or left the "
      "surface; expected smaller elements, a wider diffusion.off, or a seed with more room about it",
      sim::timesOf(failure.tally.trials, Outcome::blocked),
      sim::timesOf(failure.tally.trials, Outcome::too_far));
}

std::string ofTrials(const SeedFailure& failure) {
  if (failure.lays) return ofLaying(failure);
  const SeedFailure::Set* const set = triedOf(failure);
  const SeedFailure::Set tried = set != nullptr ? *set : SeedFailure::Set();
  const std::string more = others(failure.tally.trials);
  switch (failure.reason) {
    case Outcome::too_far:
      return fmt::format("no trial stayed within {} of the scene: {}{}",
                         limitOf(tried.proximity_max, failure.voxel_m), wallOf(failure, tried.proximity_max),
                         more);
    case Outcome::too_near:
      return fmt::format("no trial kept {} from the scene: {}{}",
                         limitOf(tried.proximity_min, failure.voxel_m), wallOf(failure, tried.proximity_min),
                         more);
    case Outcome::out_of_world:
      return fmt::format("no trial stayed in the world: its rim is {} away{}",
                         sim::counted(static_cast<std::uint64_t>(failure.rim_vx), "voxel"), more);
    default:
      return fmt::format("every trial was blocked: {} of the 26 voxels around the seed are taken{}",
                         failure.taken, more);
  }
}

/// A reason in two or three words, for many seeds at once.
std::string titleOf(Outcome reason) {
  switch (reason) {
    case Outcome::forbidden:
      return "growth is forbidden there";
    case Outcome::too_dark:
      return "too dark";
    case Outcome::too_bright:
      return "too bright";
    case Outcome::unmet:
      return "what they require did not hold";
    case Outcome::resting:
      return "resting";
    case Outcome::claimed:
      return "others were first";
    case Outcome::too_far:
      return "too far from the scene";
    case Outcome::too_near:
      return "too near to the scene";
    case Outcome::out_of_world:
      return "at the world's rim";
    default:
      return "blocked";
  }
}

/// The first few names, and how many more there are.
std::string firstOf(const std::vector<const Plant*>& plants) {
  constexpr std::size_t kMost = 3;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(kMost, plants.size()); ++i) names.push_back(plants[i]->name);
  const std::string more = plants.size() > kMost ? fmt::format(" and {} more", plants.size() - kMost) : "";
  return fmt::format("{}{}", fmt::join(names, ", "), more);
}

constexpr std::size_t kFew = 5;    // segments of a plant that soon stopped
constexpr std::size_t kMany = 50;  // of the others

/// A line on the plants of a planting that soon stopped, if most of the others made many segments.
std::string soonStopped(const std::vector<const Plant*>& stand) {
  std::vector<std::size_t> segments;
  std::vector<const Plant*> poor;
  sim::OutcomeCounts ends{};
  for (const Plant* plant : stand) {
    segments.push_back(plant->segments);
    if (plant->given || plant->segments == 0 || plant->segments >= kFew) continue;
    poor.push_back(plant);
    for (std::size_t i = 0; i < ends.size(); ++i) ends[i] += plant->tally.sites[i];
  }
  const auto middle = segments.begin() + static_cast<std::ptrdiff_t>(segments.size() / 2);
  std::nth_element(segments.begin(), middle, segments.end());
  if (poor.empty() || *middle < kMany) return "";
  return fmt::format(
      "note: {} of {} plants of '{}' stopped at fewer than {} segments: {}; of their buds {} found "
      "no way, {} were too dark, {} too bright, {} in forbidden regions{}\n",
      poor.size(), stand.size(), stand.front()->planting, kFew, firstOf(poor),
      sim::timesOf(ends, Outcome::no_trial), sim::timesOf(ends, Outcome::too_dark),
      sim::timesOf(ends, Outcome::too_bright), sim::timesOf(ends, Outcome::forbidden), unmetAmong(ends));
}

}  // namespace

std::string unmetAmong(const sim::OutcomeCounts& ends) {
  const std::uint64_t unmet = sim::timesOf(ends, Outcome::unmet);
  return unmet == 0 ? "" : fmt::format(", {} not of the age, region or senses that they require", unmet);
}

std::string whyItDidNotGrow(const SeedFailure& failure) {
  switch (failure.reason) {
    case Outcome::forbidden:
      return fmt::format("the nearest region is '{}', and {} forbids growth there", failure.region,
                         inQuotes(failure.forbidden_by));
    case Outcome::unmet:
      if (sim::timesOf(failure.tally.sites, Outcome::unmet) == 0)
        return "no trial met require.along" + others(failure.tally.trials);
      return "where and when it stood, its rules' require.age, require.in_region or require.senses was not "
             "met";
    case Outcome::too_dark:
    case Outcome::too_bright:
      return ofLight(failure, failure.reason);
    case Outcome::resting: {
      const SeedFailure::Set* const set = triedOf(failure);
      return fmt::format(
          "it rested in all {} iterations: with {:.2f} of the light the rules let it grow in one of {:.3g}",
          sim::timesOf(failure.tally.sites, Outcome::resting), set != nullptr ? set->exposure : 0.0,
          set != nullptr ? 1.0 / set->pace : 1.0);
    }
    case Outcome::claimed:
      return fmt::format("others took its voxels first, {}",
                         sim::counted(sim::timesOf(failure.tally.sites, Outcome::claimed), "time"));
    default:
      return ofTrials(failure);
  }
}

std::string poorPlants(const std::vector<Plant>& plants) {
  constexpr std::size_t kMostLines = 8;
  std::vector<std::string> lines;
  std::map<std::pair<std::string, Outcome>, std::size_t> number;  // of a group
  std::vector<std::vector<const Plant*>> groups, stands;
  std::map<std::string, std::size_t> stand_number;
  for (const Plant& plant : plants) {
    const auto [stand, new_stand] = stand_number.try_emplace(plant.planting, stands.size());
    if (new_stand) stands.emplace_back();
    stands[stand->second].push_back(&plant);
    if (!plant.failure) continue;
    const auto [group, new_group] =
        number.try_emplace({plant.planting, plant.failure->reason}, groups.size());
    if (new_group) groups.emplace_back();
    groups[group->second].push_back(&plant);
  }
  for (const auto& group : groups) {
    const Plant& first = *group.front();
    const std::string why = whyItDidNotGrow(*first.failure);
    if (group.size() == 1) {
      lines.push_back(fmt::format("note: '{}' did not grow: {}\n", first.name, why));
      continue;
    }
    lines.push_back(fmt::format("note: {} of {} seeds of '{}' did not grow, {}: {}. Of '{}': {}\n",
                                group.size(), stands[stand_number.at(first.planting)].size(), first.planting,
                                titleOf(first.failure->reason), firstOf(group), first.name, why));
  }
  for (const auto& stand : stands) {
    if (std::string line = soonStopped(stand); !line.empty()) lines.push_back(std::move(line));
  }
  std::string text;
  const std::size_t shown = lines.size() > kMostLines ? kMostLines - 1 : lines.size();
  for (std::size_t i = 0; i < shown; ++i) text += lines[i];
  if (shown < lines.size())
    text += fmt::format("note: and {} more such lines; report.json has all plants\n", lines.size() - shown);
  return text;
}

}  // namespace espalier::scenes
