#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/tile/build_world.h"
#include "sim/world/world.h"
#include "tests/support/meshes.h"
#include "tests/support/messages.h"

namespace espalier::sim {
namespace {

TEST(FrameAround, HoldsTheMeshesAndTheirMargin) {
  const std::vector<TiledMesh> meshes{{tests::boxMesh({-1, 0, 2}, {1, 3, 2.5}), false}};
  const Frame frame = frameAround(meshes, 0.25, 0.5);
  EXPECT_EQ(frame.size, Voxel(12, 16, 6));
  EXPECT_EQ(frame.voxel_m, 0.25);
  EXPECT_EQ(worldFromVoxel(frame, Vec3(-0.5)), Vec3(-1.5, -0.5, 1.5));
}

TEST(FrameAround, LosesNoVoxelEvenWithoutMargin) {
  // High faces lie between two layers and belong to the upper one, which must be there.
  for (const double voxel : {0.1, 0.25, 0.3, 1.0 / 3.0, 0.7}) {
    const std::vector<TiledMesh> meshes{{tests::boxMesh({0.1, 0.2, 0.3}, {1.1, 1.2, 1.3}), false}};
    Frame frame = frameAround(meshes, voxel, 0.0);
    const std::size_t count = buildWorld(frame, meshes, 0).occupied().count();
    frame.size += 4;
    frame.origin_m -= Vec3(2 * voxel);
    EXPECT_EQ(buildWorld(frame, meshes, 0).occupied().count(), count) << voxel;
  }
}

TEST(FrameAround, AsksForSomethingToHold) {
  EXPECT_THROW(frameAround({}, 0.1, 0.0), InputError);
  EXPECT_THROW(frameAround({{tests::emptyMesh("nothing"), false}}, 0.1, 0.0), InputError);
  const std::vector<TiledMesh> meshes{{tests::boxMesh(Vec3(0.0), Vec3(1.0)), false}};
  for (const double voxel : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(frameAround(meshes, voxel, 0.0), InputError);
  }
  for (const double margin : {-0.1, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(frameAround(meshes, 0.1, margin), InputError);
  }
}

TEST(RequireFits, NamesAVoxelSizeThatWouldFit) {
  const std::vector<TiledMesh> meshes{{tests::boxMesh(Vec3(0.0), Vec3(10, 7, 9)), false}};
  for (const double voxel : {0.001, 1e-5, 1e-9, 1e-300}) {
    const std::string message = tests::messageOf([&] { frameAround(meshes, voxel, 0.1); });
    const std::string before = "a voxel size of ";
    const std::size_t at = message.find(before);
    ASSERT_NE(at, std::string::npos) << message;
    EXPECT_TRUE(message.ends_with(" m would fit")) << message;
    const double fitting = std::stod(message.substr(at + before.size()));
    EXPECT_NO_THROW(requireFits(frameAround(meshes, fitting, 0.1)));
    EXPECT_ANY_THROW(frameAround(meshes, fitting * 0.8, 0.1));
  }
}

TEST(RequireFits, RefusesVoxelsThatNoGridCanHold) {
  const auto refused = [](double voxel_m) {
    return tests::messageOf(
        [=] { requireFits({.origin_m = Vec3(0.0), .voxel_m = voxel_m, .size = Voxel(9)}); });
  };
  EXPECT_EQ(refused(1e-30),
            "voxels of 1e-30 m; expected 2e-05 to 1000000 m: a scale for the meshes makes all of it larger "
            "or smaller");
  EXPECT_TRUE(refused(1.9e-5).starts_with("voxels of 1.9e-05 m; expected "));
  const std::vector<TiledMesh> huge{{tests::boxMesh(Vec3(0.0), Vec3(1e30)), false}};
  EXPECT_TRUE(tests::messageOf([&] { frameAround(huge, 0.05, 0.0); })
                  .ends_with("along an axis; expected it smaller: a scale for the meshes makes all of it "
                             "larger or smaller"));
  EXPECT_TRUE(refused(1e30).starts_with("voxels of 1e+30 m; expected "));
  for (const double voxel_m : {kLeastVoxel_m, 0.05, kMostVoxel_m}) {
    EXPECT_EQ(refused(voxel_m), "no error");
    EXPECT_NO_THROW(World({.origin_m = Vec3(0.0), .voxel_m = voxel_m, .size = Voxel(9)}));
  }
}

TEST(RequireFits, SaysWhatIsNeeded) {
  const std::string message = tests::messageOf([] {
    requireFits({.origin_m = Vec3(0.0), .voxel_m = 0.01, .size = {16000, 16000, 16000}});
  });
  EXPECT_TRUE(message.starts_with("a world of 16000 x 16000 x 16000 voxels of 0.01 m needs 4")) << message;
  EXPECT_NE(message.find(" GB of memory, and "), std::string::npos) << message;
}

TEST(RequireFits, NeitherOverflowsNorAllocates) {
  const int most = std::numeric_limits<int>::max();
  for (const Voxel size :
       {Voxel(most), Voxel(most, 1, 1), Voxel(20000, 20000, 20000), Voxel(1 << 16, 1 << 16, 1)}) {
    const Frame frame{.origin_m = Vec3(0.0), .voxel_m = 0.01, .size = size};
    EXPECT_THROW(requireFits(frame), InputError);
    EXPECT_THROW(buildWorld(frame, {}, 4), InputError);
  }
  EXPECT_NO_THROW(requireFits({.origin_m = Vec3(0.0), .voxel_m = 0.01, .size = {165, 150, 195}}));
}

TEST(RequireFits, RefusesWorldsThatAreNone) {
  EXPECT_THROW(requireFits({.origin_m = Vec3(0.0), .voxel_m = 1.0, .size = {0, 5, 5}}), InputError);
  EXPECT_THROW(requireFits({.origin_m = Vec3(0.0), .voxel_m = 1.0, .size = {5, -5, 5}}), InputError);
  EXPECT_THROW(requireFits({.origin_m = Vec3(0.0), .voxel_m = 0.0, .size = {5, 5, 5}}), InputError);
  EXPECT_THROW(requireFits({.origin_m = Vec3(0.0), .voxel_m = std::nan(""), .size = {5, 5, 5}}), InputError);
}

}  // namespace
}  // namespace espalier::sim
