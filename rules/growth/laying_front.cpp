#include "rules/growth/laying_front.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "sim/base/random.h"

namespace espalier::rules {
namespace {

using Whole = std::vector<std::int32_t>;

// Whose turn it will be in the next round, and who is waiting for it in this one: site by site its plant and
// its number, and of the latter the number of its turn, in the order in which they are asked.
constexpr const char *kFrontPlant = "front_plant", *kFrontNumber = "front_number";
constexpr const char *kWaitingPlant = "waiting_plant", *kWaitingNumber = "waiting_number",
                     *kWaitingTurn = "waiting_turn";
// One number each: those that were asked; rounds that were begun; in which iteration how many; and how many
// elements this one has laid.
constexpr const char *kAsked = "asked", *kRound = "round", *kIteration = "iteration",
                     *kRoundsOfIt = "rounds_of_iteration", *kLaid = "laid_in_round";

std::int32_t& single(sim::Columns& memory, const char* name) {
  Whole& column = sim::column<std::int32_t>(memory, name);
  if (column.empty()) column.push_back(0);
  return column.front();
}

std::int32_t single(const sim::Columns& memory, const char* name) {
  const Whole& column = sim::column<std::int32_t>(memory, name);
  return column.empty() ? 0 : column.front();
}

void join(sim::Columns& memory, std::int32_t plant, std::uint32_t number) {
  sim::column<std::int32_t>(memory, kFrontPlant).push_back(plant);
  sim::column<std::int32_t>(memory, kFrontNumber).push_back(static_cast<std::int32_t>(number));
}

/// Gives everybody in the front a turn: those of one turn stand in cells of which none lies beside another,
/// or one for each cell.
void beginRound(sim::Columns& memory, double apart_vx,
                const std::function<sim::Vec3(std::int32_t, std::uint32_t)>& placeOf) {
  Whole &plants = sim::column<std::int32_t>(memory, kFrontPlant),
        &numbers = sim::column<std::int32_t>(memory, kFrontNumber);
  struct Waiting {
    std::int32_t turn, plant, number;
  };
  std::vector<Waiting> waiting;
  std::vector<std::size_t> order(plants.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(plants[a], numbers[a]) < std::tie(plants[b], numbers[b]);
  });
  std::map<std::tuple<int, int, int>, std::int32_t> in_cell;
  for (const std::size_t i : order) {
    const sim::Voxel cell(
        glm::floor(placeOf(plants[i], static_cast<std::uint32_t>(numbers[i])) / std::max(1.0, apart_vx)));
    const std::int32_t before = in_cell[{cell.x, cell.y, cell.z}]++;
    const std::int32_t parity = (cell.x & 1) | (cell.y & 1) << 1 | (cell.z & 1) << 2;
    waiting.push_back({before * 8 + parity, plants[i], numbers[i]});
  }
  std::stable_sort(waiting.begin(), waiting.end(),
                   [](const Waiting& a, const Waiting& b) { return a.turn < b.turn; });
  plants.clear();
  numbers.clear();
  Whole &turn = sim::column<std::int32_t>(memory, kWaitingTurn),
        &plant = sim::column<std::int32_t>(memory, kWaitingPlant),
        &number = sim::column<std::int32_t>(memory, kWaitingNumber);
  for (Whole* column : {&turn, &plant, &number}) column->clear();
  for (const Waiting& site : waiting) {
    turn.push_back(site.turn);
    plant.push_back(site.plant);
    number.push_back(site.number);
  }
  single(memory, kAsked) = 0;
  single(memory, kLaid) = 0;
  ++single(memory, kRound);
  ++single(memory, kRoundsOfIt);
}

bool allAsked(const sim::Columns& memory) {
  return static_cast<std::size_t>(single(memory, kAsked)) ==
         sim::column<std::int32_t>(memory, kWaitingTurn).size();
}

}  // namespace

void beginLaying(const sim::StandView& stand, sim::Columns& memory) {
  for (std::size_t i = 0; i < stand.plants.size(); ++i) join(memory, static_cast<std::int32_t>(i), kSeedSite);
}

std::vector<sim::Site> dueOfLaying(const sim::StandView& stand, sim::Columns& memory, double apart_vx,
                                   const std::function<sim::Vec3(const sim::Site&)>& placeOf) {
  if (single(memory, kIteration) != stand.iteration) {
    single(memory, kIteration) = stand.iteration;
    single(memory, kRoundsOfIt) = 0;
  }
  if (allAsked(memory)) {
    beginRound(memory, apart_vx, [&](std::int32_t plant, std::uint32_t number) {
      return placeOf({plant, 0, number, sim::Vec3(0.0)});
    });
  }
  const Whole &turn = sim::column<std::int32_t>(memory, kWaitingTurn),
              &plant = sim::column<std::int32_t>(memory, kWaitingPlant),
              &number = sim::column<std::int32_t>(memory, kWaitingNumber);
  std::vector<sim::Site> sites;
  for (auto i = static_cast<std::size_t>(single(memory, kAsked));
       i < turn.size() && turn[i] == turn[static_cast<std::size_t>(single(memory, kAsked))]; ++i) {
    sim::Site site{plant[i], 0, static_cast<std::uint32_t>(number[i]), sim::Vec3(0.0)};
    site.at_vx = placeOf(site);
    sites.push_back(site);
  }
  return sites;
}

void settleLaying(std::span<const sim::Verdict> verdicts, sim::Columns& memory) {
  single(memory, kAsked) += static_cast<std::int32_t>(verdicts.size());
  for (const sim::Verdict& verdict : verdicts) {
    const sim::Site& site = verdict.site;
    const bool grew = verdict.outcome == sim::Outcome::grown && verdict.elements > 0;
    if (grew && verdict.first_element + 1 < sim::Slots::kNumbers)
      join(memory, site.plant, static_cast<std::uint32_t>(verdict.first_element) + 1);
    if (grew) ++single(memory, kLaid);
    // A seed has done its part.
    const bool goes_on = grew ? site.number != kSeedSite
                              : verdict.outcome == sim::Outcome::claimed || !verdict.proposal->retire;
    if (goes_on) join(memory, site.plant, site.number);
  }
}

void endLaying(sim::Columns& memory) {
  for (const char* name : {kFrontPlant, kFrontNumber, kWaitingPlant, kWaitingNumber, kWaitingTurn})
    sim::column<std::int32_t>(memory, name).clear();
  single(memory, kAsked) = 0;
}

bool layingGoesOn(const sim::Columns& memory, int rounds) {
  if (!allAsked(memory)) return true;
  // Those that rest would do so round by round.
  if (single(memory, kLaid) == 0) return false;
  return single(memory, kRoundsOfIt) < rounds && !sim::column<std::int32_t>(memory, kFrontPlant).empty();
}

std::size_t countLaying(const sim::Columns& memory) {
  return sim::column<std::int32_t>(memory, kFrontPlant).size() +
         sim::column<std::int32_t>(memory, kWaitingPlant).size() -
         static_cast<std::size_t>(single(memory, kAsked));
}

std::uint32_t roundOf(const sim::Columns& memory) {
  return static_cast<std::uint32_t>(single(memory, kRound));
}

}  // namespace espalier::rules
