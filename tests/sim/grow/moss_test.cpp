#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "docs/examples/moss.h"
#include "sim/base/parallel.h"
#include "sim/grow/grow.h"
#include "sim/light/sky.h"
#include "tests/support/plots.h"

/// The worked example of docs/house.md does what the page says.
namespace espalier {
namespace {

/// A bench before a wall: shade below and behind it, and open sky above.
sim::World benchPlot() {
  sim::World world = tests::wallPlot();
  tests::addBox(world, "bench", {8, 6, 22}, {40, 7, 34});
  world.setLayers(2);
  return world;
}

struct Grown {
  sim::World world = benchPlot();
  sim::Growth growth;
  explicit Grown(int iterations = 150, double most_sky = 0.3) {
    sim::GrowthSettings settings;
    settings.iterations = iterations;
    settings.light.sky = sim::makeSky({.directions = 200}).directions;
    growth = sim::grow(
        world,
        {{"moss", examples::makeMoss(most_sky), sim::seedsAt(world.frame(), {{24, 1, 26}, {12, 1, 24}})}},
        settings);
  }
};

TEST(Moss, CreepsOverWhatStandsInTheShade) {
  const Grown moss;
  std::size_t cushions = 0;
  int on_bench = 0;
  bool on_soil = false, on_wall = false, below_bench = false;
  for (const sim::Plant& plant : moss.growth.plants) {
    cushions += plant.elements.size();
    for (const sim::PlacedElement& e : plant.elements) {
      const sim::Voxel at = sim::voxelAt(e.position_vx);
      EXPECT_EQ(moss.world.nearnessAt(at)->layer, 1);
      on_bench += at.y == 8 && at.z > 26;
      on_soil = on_soil || e.z.y > 0.9;
      on_wall = on_wall || e.z.z > 0.9;
      below_bench = below_bench || e.z.y < -0.9;
    }
  }
  EXPECT_GT(cushions, 500u);
  EXPECT_TRUE(on_soil && on_wall && below_bench);
  EXPECT_LT(on_bench, 10);  // which lies in the sun
  const sim::Tally tally = sim::total(moss.growth);
  for (const sim::Outcome outcome : {sim::Outcome::too_bright, sim::Outcome::blocked, sim::Outcome::claimed})
    EXPECT_GT(tally.sites[static_cast<std::size_t>(outcome)], 0u) << sim::nameOf(outcome);
}

TEST(Moss, EndsWhereNothingIsLeftToTry) {
  const Grown moss(10'000, 0.0);
  EXPECT_LT(moss.growth.iterations, 50);
  EXPECT_TRUE(moss.growth.plants[0].elements.empty());
}

TEST(Moss, IsTheSameOnAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 5}) {
    sim::onThreads(threads, [&] {
      const Grown moss;
      hashes.push_back(sim::stateHash(moss.world, moss.growth));
    });
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  const Grown brighter(150, 0.31);  // a little more light is another moss
  EXPECT_NE(hashes[0], sim::stateHash(brighter.world, brighter.growth));
}

TEST(Moss, StandsInThePageAsItIsBuilt) {
  const auto textOf = [](const std::string& file) {
    std::ifstream in(ESPALIER_SOURCE_DIR "/" + file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string moss = textOf("docs/examples/moss.cpp");
  EXPECT_GT(moss.size(), 1000u);
  EXPECT_NE(textOf("docs/house.md").find("```cpp\n" + moss + "```\n"), std::string::npos);
}

}  // namespace
}  // namespace espalier
