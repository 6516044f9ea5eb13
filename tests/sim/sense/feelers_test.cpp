#include "sim/sense/feelers.h"

#include <gtest/gtest.h>

#include <random>

#include "sim/sweep/lanes.h"
#include "tests/support/plain_feelers.h"
#include "tests/support/plots.h"

namespace espalier::sim {
namespace {

/// Twigs strewn over the plot: half of what segments meet.
World strewnPlot(Voxel size, unsigned seed) {
  World world = tests::wallPlot(size);
  std::mt19937 random(seed);
  const PartId twig = world.addPart({"vine", "stem", PartKind::stem, 0});
  std::vector<TiledVoxel> twigs;
  const PartId own = world.addPart({"vine", "leaf", PartKind::element, 0});
  const PartId foreign = world.addPart({"ivy", "leaf", PartKind::element, 1});
  for (int i = 0; i < size.x * size.y * size.z / 8; ++i) {
    const int x = static_cast<int>(random() % static_cast<unsigned>(size.x));
    const int y = static_cast<int>(random() % static_cast<unsigned>(size.y));
    const int z = static_cast<int>(random() % static_cast<unsigned>(size.z));
    twigs.push_back({{x, y, z}, {i % 3 == 0 ? own : i % 7 == 0 ? foreign : twig, Colour(0.1f), 0.2f}});
  }
  world.occupy(twigs);
  return world;
}

void expectAsPlain(const World& world, int longest_vx, unsigned seed, const std::string& what) {
  std::mt19937 random(seed);
  const Voxel size = world.frame().size;
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  int fates[3] = {};
  Room room;
  for (int round = 0; round < 40; ++round) {
    // On the lattice, off it, in a corner of the world, and at voxels' very faces.
    Vec3 from;
    for (int axis = 0; axis < 3; ++axis) from[axis] = number(-0.49, size[axis] - 0.51);
    if (round % 4 == 1) from = glm::floor(from * 4096.0) / 4096.0;
    if (round % 4 == 2) from = glm::floor(from) + 0.5 - 1.0 / 4096;
    if (round % 8 == 3) from = Vec3(size) - 1.0;
    from = glm::clamp(from, Vec3(0.0), Vec3(size) - 1.0);
    const Voxel at = voxelAt(from);
    std::vector<Voxel> attachment = {at, at + Voxel(1, 0, 0), at - Voxel(0, 0, longest_vx + 3)};
    if (round % 5 == 0) attachment.clear();
    const Passage passage = round % 3 == 0 ? Passage::through : Passage::around;
    Offsets ends;
    const std::size_t count = 1 + random() % Offsets::kMost;
    for (std::size_t i = 0; i < count; ++i) {
      const auto offset = [&] {
        return static_cast<std::int32_t>(number(-longest_vx, longest_vx) * 4096 * number(0.0, 1.0));
      };
      ends.x[i] = i % 7 == 0 ? 0 : offset();
      ends.y[i] = i % 11 == 0 ? 0 : offset();
      ends.z[i] = i % 13 == 0 ? 4096 : offset();
    }
    roomAround(world, at, longest_vx + 1, attachment, passage, 0, room);
    Felt felt;
    feel(world, room, from, ends, count, felt);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 to = endOf(from, ends, i);
      const tests::PlainFelt plain = tests::plainFeel(world, from, to, attachment, passage, 0);
      const auto is = [&](std::uint64_t bits) { return (bits >> i & 1u) != 0; };
      const Fit fate = is(felt.clear) ? Fit::clear : is(felt.outside) ? Fit::outside : Fit::blocked;
      ASSERT_EQ(fate, plain.fate) << what << ", round " << round << ", segment " << i;
      ASSERT_FALSE(is(felt.clear) && is(felt.outside));
      ++fates[static_cast<int>(fate)];
      if (fate != Fit::clear) continue;
      ASSERT_EQ(felt.proximity_vx[i], plain.proximity_vx) << what << ", round " << round << ", segment " << i;
    }
  }
  EXPECT_GT(fates[static_cast<int>(Fit::clear)], 50) << what;
  EXPECT_GT(fates[static_cast<int>(Fit::blocked)], 50) << what;
  EXPECT_GT(fates[static_cast<int>(Fit::outside)], 20) << what;
}

TEST(Feelers, FeelWhatTheTilerAndFitSay) {
  for (const std::string& level : lanes::levels()) {
    lanes::useLevel(level);
    for (const int longest : {1, 3, 7, 8, 20, 60})
      expectAsPlain(strewnPlot({150, 48, 40}, 3), longest, static_cast<unsigned>(longest), level);
    expectAsPlain(strewnPlot({64, 64, 64}, 4), 5, 1, level);
    expectAsPlain(strewnPlot({70, 24, 9}, 5), 12, 2, level);
  }
  lanes::useLevel(lanes::levels().front());
}

}  // namespace
}  // namespace espalier::sim
