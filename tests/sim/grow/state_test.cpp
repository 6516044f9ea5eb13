#include "sim/grow/state.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>
#include <string_view>

#include "sim/base/error.h"
#include "sim/grow/grow.h"
#include "tests/support/plots.h"
#include "tests/support/processes.h"
#include "tests/support/worlds.h"

namespace espalier {
namespace {

using sim::Vec3;

const sim::Inputs kInputs = {{"seed", "1"}, {"world.voxel", "4 cm"}};

std::vector<sim::Planting> tilesAndCreeper(const sim::Frame& frame) {
  return {{"tiles", std::make_shared<tests::Tiler>(), sim::seedsAt(frame, {{10, 3, 10}, {30, 3, 10}})},
          {"creeper", std::make_shared<tests::Creeper>(), sim::seedsAt(frame, {{12, 3, 11}})}};
}

sim::GrowthSettings settingsOf(int iterations, bool record = false) {
  sim::GrowthSettings s;
  s.iterations = iterations;
  s.record_attempts = record;
  return s;
}

struct Saved {
  std::string bytes;
  std::uint64_t hash = 0;
};

Saved savedAfter(int iterations, bool record = false) {
  sim::World world = tests::wallPlot();
  const sim::BitVolume site = world.occupied();
  const auto growth = sim::grow(world, tilesAndCreeper(world.frame()), settingsOf(iterations, record));
  return {sim::stateBytes(kInputs, world, site, growth), sim::stateHash(world, growth)};
}

std::string messageOf(const std::string& bytes) {
  try {
    sim::World world = tests::wallPlot();
    sim::restore(sim::readState(bytes, "growth.state"), world, tilesAndCreeper(world.frame()),
                 "growth.state");
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(State, GoesOnAsIfNothingHadHappened) {
  const Saved whole = savedAfter(14);
  for (const int before : {0, 1, 5, 13, 14}) {
    const Saved part = savedAfter(before);
    sim::World world = tests::wallPlot();
    const sim::BitVolume site = world.occupied();
    auto restored = sim::restore(sim::readState(part.bytes, "f"), world, tilesAndCreeper(world.frame()), "f");
    EXPECT_EQ(sim::stateHash(world, restored), part.hash);
    EXPECT_TRUE(tests::keepsItsBricks(world));
    std::size_t proposals = 0;
    auto going_on = settingsOf(14);
    going_on.progress = [&](const sim::GrowthProgress& p) {
      proposals = p.proposals;
      EXPECT_GT(p.iteration, before);
    };
    sim::Growing growing(world, tilesAndCreeper(world.frame()), going_on, std::move(restored));
    while (growing.step()) {
    }
    EXPECT_EQ(growing.growth().iterations, 14);
    EXPECT_EQ(sim::stateHash(world, growing.growth()), whole.hash) << before;
    EXPECT_TRUE(tests::keepsItsBricks(world));
    EXPECT_EQ(sim::stateBytes(kInputs, world, site, growing.growth()), whole.bytes) << before;
    EXPECT_EQ(proposals > 0, before < 14);
  }
  const Saved shorter = savedAfter(13);  // an iteration less would show in both
  EXPECT_NE(shorter.hash, whole.hash);
  EXPECT_NE(shorter.bytes, whole.bytes);
}

TEST(State, KeepsTheTrialsThatWereRecorded) {
  const Saved saved = savedAfter(4, true);
  const auto state = sim::readState(saved.bytes, "f");
  EXPECT_TRUE(state.growth.recorded);
  EXPECT_GT(state.growth.attempts.size(), 3u);
  EXPECT_EQ(state.inputs, kInputs);
  EXPECT_FALSE(sim::readState(savedAfter(4).bytes, "f").growth.recorded);
}

TEST(State, DamageIsAnErrorThatNamesTheFile) {
  const std::string good = savedAfter(6).bytes;
  ASSERT_EQ(messageOf(good), "");
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    std::string bad = good;
    if (i % 2 == 0) {
      bad.resize(random() % good.size());
    } else {
      bad[random() % good.size()] ^= static_cast<char>(1 + random() % 255);
    }
    EXPECT_TRUE(messageOf(bad).starts_with("growth.state: ")) << messageOf(bad);
  }
  EXPECT_NE(messageOf("").find("no saved state"), std::string::npos);
  EXPECT_NE(messageOf("espalier state ").find("no saved state"), std::string::npos);
  EXPECT_NE(messageOf("espalier state 2\n" + good.substr(17)).find("version 2;"), std::string::npos);
  EXPECT_NE(messageOf("espalier state 12\n" + good.substr(17)).find("version 12;"), std::string::npos);
}

TEST(State, NumbersThatGrowthNeverWritesAreAnErrorToo) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr auto kFar = std::numeric_limits<std::int32_t>::min();
  const std::string bytes = savedAfter(6, true).bytes;
  const auto restored = [&](const std::function<void(sim::State&)>& change) {
    sim::World world = tests::wallPlot();
    const auto words = world.occupied().words();
    sim::State state = sim::readState(bytes, "f");
    change(state);
    try {
      sim::restore(std::move(state), world, tilesAndCreeper(world.frame()), "f");
    } catch (const sim::InputError& error) {
      EXPECT_TRUE(std::string_view(error.what()).starts_with("f: the state is damaged: ")) << error.what();
      EXPECT_EQ(world.occupied().words(), words);
      return false;
    }
    return true;
  };
  const auto tile = [](sim::State& s) -> sim::PlacedElement& { return s.growth.plants[0].elements.at(0); };
  const auto surface = [](sim::State& s) -> sim::Surface& { return s.voxels.at(0).surface; };
  EXPECT_TRUE(restored([](sim::State&) {}));
  EXPECT_FALSE(restored([](sim::State& s) { s.growth.plants[2].skeleton.born.back() = kFar; }));
  EXPECT_FALSE(restored([](sim::State& s) { s.growth.plants[2].skeleton.born.back() = 7; }));
  EXPECT_FALSE(restored([&](sim::State& s) { tile(s).born = kFar; }));
  EXPECT_FALSE(restored([&](sim::State& s) { tile(s).born = 7; }));
  EXPECT_FALSE(restored([&](sim::State& s) { tile(s).exposure = static_cast<float>(kNone); }));
  EXPECT_FALSE(restored([&](sim::State& s) { surface(s).coverage = static_cast<float>(kNone); }));
  EXPECT_FALSE(restored([&](sim::State& s) { surface(s).coverage = -1.0f; }));
  EXPECT_FALSE(restored([&](sim::State& s) { surface(s).colour.g = static_cast<float>(kNone); }));
  EXPECT_FALSE(restored([&](sim::State& s) { surface(s).normal.z = static_cast<float>(kNone); }));
  EXPECT_FALSE(restored([&](sim::State& s) { surface(s).offset_vx = static_cast<float>(kNone); }));
  EXPECT_FALSE(restored([](sim::State& s) { s.growth.attempts.at(0).to_vx.y = kNone; }));
  EXPECT_FALSE(restored([](sim::State& s) { s.growth.attempts.at(0).from_vx.x = 1e300; }));
}

TEST(State, BelongsToItsSiteAndItsPlantings) {
  const std::string bytes = savedAfter(6).bytes;
  const auto refused = [&](sim::World world, std::vector<sim::Planting> planted) {
    const auto words = world.occupied().words();
    EXPECT_THROW(sim::restore(sim::readState(bytes, "f"), world, planted, "f"), sim::InputError);
    EXPECT_EQ(world.occupied().words(), words);
  };
  const sim::Frame frame = tests::wallPlot().frame();
  refused(tests::wallPlot({48, 48, 41}), tilesAndCreeper(frame));
  auto fewer = tilesAndCreeper(frame);
  fewer.pop_back();
  refused(tests::wallPlot(), fewer);
  auto moved = tilesAndCreeper(frame);
  moved[0].seeds[1].key ^= 1;
  refused(tests::wallPlot(), moved);
  auto others = tilesAndCreeper(frame);
  others[1].process = std::make_shared<tests::Tiler>();
  refused(tests::wallPlot(), others);
  sim::World fuller = tests::wallPlot();
  tests::addBox(fuller, "shed", {8, 1, 8}, {14, 6, 14});
  refused(std::move(fuller), tilesAndCreeper(frame));
}

}  // namespace
}  // namespace espalier
