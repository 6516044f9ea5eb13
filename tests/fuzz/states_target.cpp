// Saved states: the reader, putting one into a site, and growing on from it. Any bytes may stand behind a
// right checksum, which keeps damage away and nobody who means it.
#include <fmt/format.h>
#include <xxhash.h>

#include <optional>

#include "render/model/plant_model.h"
#include "rules/growth/front_memory.h"
#include "scenes/job/saved_growth.h"
#include "sim/base/error.h"
#include "sim/base/hasher.h"
#include "sim/grow/state.h"
#include "tests/fuzz/target.h"
#include "tests/support/colonies.h"
#include "tests/support/lively.h"
#include "tests/support/plots.h"

namespace espalier::fuzz {
namespace {

constexpr std::string_view kHeader = "espalier state 1\n";

const sim::World& plot() {
  static const sim::World world = tests::wallPlot({20, 18, 16}, 3);
  return world;
}

const std::vector<sim::Planting>& plantings() {
  static const std::vector<sim::Planting> planted = [] {
    auto vines = tests::planting(plot(), tests::lively(), {{5, 2, 11}, {14, 2, 11}});
    rules::RuleSet through = tests::lively();
    through.require.clear = false;
    const auto more = tests::planting(plot(), through, {{9, 2, 3}}, "through");
    vines.insert(vines.end(), more.begin(), more.end());
    const auto trees = tests::planting(plot(), tests::tree(), {{4, 2, 5}, {15, 2, 5}}, "trees");
    vines.insert(vines.end(), trees.begin(), trees.end());
    return vines;
  }();
  return planted;
}

sim::GrowthSettings settings(int iterations) {
  static const sim::GrowthSettings bright = [] {
    sim::GrowthSettings s = tests::brightSettings(0);
    s.light.sky = sim::makeSky({.directions = 16}).directions;
    s.light.sun = sim::makeSun({20.0, 180.0, 4}).directions;
    return s;
  }();
  sim::GrowthSettings s = bright;
  s.iterations = iterations;
  s.commons = tests::settings(tests::inBox(21, 60, {10, 10, 8}, {8, 6, 6})).commons;
  return s;
}

/// Goes on as a run does: what a process remembers is looked at before anything is asked of it.
void goOn(sim::World& world, sim::Growth growth) {
  constexpr int kMostIterations = 100'000;  // what a scene may ask for
  if (growth.iterations > kMostIterations) return;
  for (const sim::Plant& plant : growth.plants) render::modelPlant(plant, world.frame());
  std::optional<sim::Growing> growing;
  try {
    growing.emplace(world, plantings(), settings(growth.iterations + 2), std::move(growth));
    growing->alive();
    growing->due();
  } catch (const sim::BrokenContract&) {
    return;
  }
  while (growing->step()) {
  }
  const std::string again = sim::stateBytes({{"seed", "1"}}, world, plot().occupied(), growing->growth());
  sim::World fresh = plot();
  const sim::Growth restored = sim::restore(sim::readState(again, "f"), fresh, plantings(), "f");
  require(sim::stateHash(fresh, restored) == sim::stateHash(world, growing->growth()),
          "a state that is not what it was");
}

}  // namespace

std::vector<std::string> seeds() {
  std::vector<std::string> bytes;
  for (const int iterations : {0, 1, 3, 6}) {
    for (const bool recorded : {false, true}) {
      sim::World world = plot();
      sim::GrowthSettings s = settings(iterations);
      s.record_attempts = recorded;
      const auto growth = sim::grow(world, plantings(), s);
      const std::string whole =
          sim::stateBytes({{"espalier", "1"}, {"seed", "1"}}, world, plot().occupied(), growth);
      bytes.push_back(whole.substr(kHeader.size() + 17));
    }
  }
  bytes.emplace_back("espalier state 2\n");
  return bytes;
}

}  // namespace espalier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace espalier;
  const std::string_view given = fuzz::textOf(data, size);
  const std::string bytes =
      given.starts_with("espalier state ")
          ? std::string(given)
          : fmt::format("{}{}\n{}", fuzz::kHeader, sim::hexOf(XXH3_64bits(data, size)), given);
  try {
    sim::State state = sim::readState(bytes, "f");
    scenes::seedOf(state);
    try {
      rules::requireSoundFronts(state.growth.commons);
    } catch (const sim::BrokenContract&) {
      return 0;
    }
    sim::World world = fuzz::plot();
    fuzz::goOn(world, sim::restore(std::move(state), world, fuzz::plantings(), "f"));
  } catch (const sim::InputError& error) {
    fuzz::require(std::string_view(error.what()).starts_with("f: "), "an error that does not name the file");
  }
  return 0;
}
