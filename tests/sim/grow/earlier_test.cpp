#include "sim/grow/earlier.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "sim/grow/grow.h"
#include "tests/support/plots.h"
#include "tests/support/processes.h"
#include "tests/support/worlds.h"

namespace espalier::sim {
namespace {

constexpr int kIterations = 14;

/// Growth that is looked at after each iteration.
class Earlier : public testing::Test {
 protected:
  void SetUp() override {
    const std::vector<Planting> plantings = {
        {"tiles", std::make_shared<tests::Tiler>(), seedsAt(world_.frame(), {{10, 3, 10}, {30, 3, 10}})},
        {"creeper", std::make_shared<tests::Creeper>(), seedsAt(world_.frame(), {{12, 3, 11}})}};
    GrowthSettings settings;
    settings.iterations = kIterations;
    Growing growing(world_, plantings, settings);
    do {
      occupied_.push_back(world_.occupied());
      plants_.push_back(growing.growth().plants);
    } while (growing.step());
    growth_ = growing.take();
    ASSERT_EQ(plants_.size(), kIterations + 1u);
  }

  World world_ = tests::wallPlot();
  std::vector<BitVolume> occupied_;
  std::vector<std::vector<Plant>> plants_;
  Growth growth_;
};

void expectAlike(const Plant& a, const Plant& b) {
  EXPECT_EQ(a.skeleton.parent, b.skeleton.parent);
  EXPECT_EQ(a.skeleton.born, b.skeleton.born);
  EXPECT_EQ(a.skeleton.position_vx, b.skeleton.position_vx);
  EXPECT_EQ(a.skeleton.columns, b.skeleton.columns);
  ASSERT_EQ(a.elements.size(), b.elements.size());
  for (std::size_t i = 0; i < a.elements.size(); ++i) {
    EXPECT_EQ(a.elements[i].node, b.elements[i].node);
    EXPECT_EQ(a.elements[i].position_vx, b.elements[i].position_vx);
    EXPECT_EQ(a.elements[i].born, b.elements[i].born);
  }
}

TEST_F(Earlier, PlantsAreWhatTheyWereAfterEachIteration) {
  for (std::size_t k = 0; k <= kIterations; ++k) {
    for (std::size_t i = 0; i < growth_.plants.size(); ++i)
      expectAlike(plantAfter(growth_.plants[i], static_cast<int>(k)), plants_[k][i]);
  }
  EXPECT_GT(growth_.plants[0].elements.size(), 10u);
  EXPECT_GT(growth_.plants[2].skeleton.parent.size(), 10u);
}

TEST_F(Earlier, VoxelsAreWhatWasOccupiedAfterEachIteration) {
  const VoxelBirths births(world_, growth_.plants, growth_.iterations);
  std::size_t before = 0;
  for (int k = 0; k <= kIterations; ++k) {
    const BitVolume& then = occupied_[static_cast<std::size_t>(k)];
    BitVolume off = births.after(world_.occupied(), k), lacking = then;
    lacking.remove(off);
    off.remove(then);
    // A seed's own voxel is taken with the first of what grows from it.
    EXPECT_LE(lacking.count() + off.count(), 3u) << k;
    EXPECT_GE(births.takenAfter(k), before) << k;
    before = births.takenAfter(k);
  }
  EXPECT_EQ(before, world_.inPlants().count());
  EXPECT_GT(before, 100u);
  EXPECT_EQ(births.after(world_.occupied(), kIterations).words(), world_.occupied().words());
}

/// In skeletons that somebody else made.
TEST(EarlierPlant, ALimbThatIsOlderThanWhatCarriesItComesWithThat) {
  Plant plant;
  plant.skeleton.parent = {kNoNode, 0, 1};
  plant.skeleton.born = {0, 5, 2};
  plant.skeleton.position_vx = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
  plant.elements.resize(1);
  plant.elements[0].node = 2;
  EXPECT_EQ(plantAfter(plant, 4).skeleton.size(), 1);
  EXPECT_TRUE(plantAfter(plant, 4).elements.empty());
  EXPECT_EQ(plantAfter(plant, 6).skeleton.parent, plant.skeleton.parent);
  EXPECT_EQ(plantAfter(plant, 6).elements.size(), 1u);
}

}  // namespace
}  // namespace espalier::sim
