// Growth that would take more memory than there is ends well.
#include "sim/grow/fits.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/lively.h"
#include "tests/support/plots.h"

namespace espalier {
namespace {

sim::Growth growIn(sim::World& world, const sim::GrowthSettings& settings) {
  return sim::grow(world, tests::planting(world, tests::lively(), {tests::kOpenSeed}), settings);
}

TEST(Fits, MemoryInUseGrowsWithWhatIsWritten) {
  const double before = sim::memoryInUse();
  ASSERT_GT(before, 1e6);
  const std::vector<char> bytes(std::size_t{200} << 20, 'x');
  EXPECT_GT(sim::memoryInUse(), before + 150e6) << bytes.back();
}

TEST(Fits, GrowthThatFitsIsNotCutShort) {
  sim::World world = tests::wallPlot();
  const sim::Growth growth = growIn(world, tests::brightSettings(20));
  EXPECT_EQ(growth.iterations, 20);
  EXPECT_EQ(growth.cut_short, "");
}

TEST(Fits, WithNoRoomAtAllOnlySeedsAreLeft) {
  sim::World world = tests::wallPlot();
  auto settings = tests::brightSettings(20);
  settings.memory.budget_bytes = 0.0;
  const sim::Growth growth = growIn(world, settings);
  EXPECT_EQ(growth.iterations, 0);
  EXPECT_EQ(growth.cut_short.find("growth stopped after 0 iterations with 0 segments: "), 0u);
  EXPECT_NE(growth.cut_short.find("and 0.00 are free for it here; limit iterations, or light or proximity"),
            std::string::npos)
      << growth.cut_short;
}

TEST(Fits, GrowthEndsAfterTheLastIterationThatFitsAndGoesOnWhereThereIsMore) {
  sim::World whole_world = tests::wallPlot(), world = tests::wallPlot();
  const sim::Growth whole = growIn(whole_world, tests::brightSettings(30));
  auto settings = tests::brightSettings(30);
  settings.memory.later_a_segment = 20e6;  // so that a hundred are too many
  settings.memory.budget_bytes = sim::memoryInUse() + 2e9;
  sim::Growth part = growIn(world, settings);
  EXPECT_GT(part.iterations, 3);
  EXPECT_LT(part.iterations, 30);
  EXPECT_GT(part.plants[0].skeleton.size(), 10);
  EXPECT_LE(part.plants[0].skeleton.size(), 101);
  std::ostringstream begin;
  begin << "growth stopped after " << part.iterations << " iterations with "
        << part.plants[0].skeleton.size() - 1 << " segments: ";
  EXPECT_EQ(part.cut_short.find(begin.str()), 0u) << part.cut_short;

  sim::Growing more(world, tests::planting(world, tests::lively(), {tests::kOpenSeed}),
                    tests::brightSettings(30), std::move(part));
  while (more.step()) {
  }
  EXPECT_EQ(more.growth().cut_short, "");
  EXPECT_EQ(sim::stateHash(world, more.growth()), sim::stateHash(whole_world, whole));
  sim::World shorter_world = tests::wallPlot();
  const sim::Growth shorter = growIn(shorter_world, tests::brightSettings(29));
  EXPECT_NE(sim::stateHash(shorter_world, shorter), sim::stateHash(whole_world, whole));
}

}  // namespace
}  // namespace espalier
