// States that are whole, and hold what nobody has grown.
#include "scenes/job/saved_growth.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "scenes/job/run.h"
#include "scenes/prepare/plantings.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

constexpr const char* kScene = R"(espalier: scene
world: {voxel: 10 cm, bounds: {min: [0, 0, 0], max: [2, 2, 2]}}
sky: {directions: 16}
plants:
  - {seeds: [[1, 0.3, 1], [0.4, 0.3, 0.4]], rules: {random_tree: {trials: {min: 2, max: 9}}}}
iterations: 8
)";

class KeptMemory : public testing::Test {
 protected:
  void SetUp() override {
    auto read = readScene(scratch_.write("scene.yaml", kScene));
    ASSERT_TRUE(read);
    scene_ = *read;
    options_.folder = scratch_.path("out");
    options_.pictures = false;
  }

  /// What a run says that goes on from a state in which something of what buds remember is another.
  std::string goesOn(const std::function<void(sim::Columns&)>& change) {
    Scene half = scene_;
    half.iterations = 4;
    runScene(half, options_);
    Site site = makeSite(half);
    const sim::BitVolume bare = site.world.occupied();
    sim::Growth growth = takeUp(*readKept(options_.folder), options_.folder, half, site,
                                makePlantings(half, site), Same::everything);
    change(growth.stands.at(0).memory);
    scratch_.write("out/growth.state", sim::stateBytes(inputsOf(half, site), site.world, bare, growth));
    try {
      runScene(scene_, options_, {.resume = true});
    } catch (const sim::InputError& error) {
      return error.what();
    }
    return "";
  }

  tests::Scratch scratch_;
  Scene scene_;
  RunOptions options_;
};

TEST_F(KeptMemory, ThatIsNoneIsADamagedState) {
  using Numbers = std::vector<std::int32_t>;
  const auto buds = [](sim::Columns& memory, const char* name) -> Numbers& {
    return sim::column<std::int32_t>(memory, name);
  };
  EXPECT_EQ(goesOn([](sim::Columns&) {}), "");
  const std::string file = (options_.folder / kStateFile).string();
  const auto damaged = [&](const std::function<void(sim::Columns&)>& change) {
    const std::string said = goesOn(change);
    EXPECT_TRUE(said.starts_with(file + ": the state is damaged: ")) << said;
  };
  damaged([&](sim::Columns& m) { buds(m, "bud_node").back() = 9999; });
  damaged([&](sim::Columns& m) { buds(m, "bud_plant").back() = -1; });
  damaged([&](sim::Columns& m) { buds(m, "bud_due").pop_back(); });
  damaged([&](sim::Columns& m) { buds(m, "bud_number").back() = std::numeric_limits<std::int32_t>::max(); });
  damaged([&](sim::Columns& m) { m["bud_plant"] = std::vector<double>(3); });
  damaged([&](sim::Columns& m) {
    for (const char* name : {"bud_plant", "bud_node", "bud_number", "bud_due"})
      buds(m, name).push_back(buds(m, name).back());
  });
  damaged([&](sim::Columns& m) {  // of which nothing would show before it is due
    buds(m, "bud_node").back() = 9999;
    buds(m, "bud_due").back() = 7;
  });
}

}  // namespace
}  // namespace espalier::scenes
