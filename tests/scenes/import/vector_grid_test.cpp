#include "scenes/import/vector_grid.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <random>

#include "sim/base/error.h"
#include "sim/base/hasher.h"
#include "sim/base/parallel.h"
#include "tests/support/messages.h"
#include "tests/support/scratch.h"
#include "tests/support/volumes.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;
using tests::vectorGrid;

class VectorGrid : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const openvdb::GridCPtrVec& grids) {
    tests::writeVolume(scratch_.path(name), grids);
    return scratch_.path(name);
  }
  VectorLattice read(const std::filesystem::path& file, const std::string& grid = "") {
    return readVectorGrid(file, grid, read_);
  }
  void expectRefused(const std::filesystem::path& file, const std::string& because,
                     const std::string& grid = "") {
    const std::string said = tests::messageOf([&] { read(file, grid); });
    EXPECT_TRUE(said.starts_with(file.string() + ": ")) << said;
    EXPECT_NE(said.find(because), std::string::npos) << said;
  }

  tests::Scratch scratch_;
  sim::InputFile read_;
};

Vec3 slanted(Vec3 m) {
  return {1.0 + m.x - 0.5 * m.z, 2.0 * m.y, m.x + m.y + m.z};
}

/// Between the points of a lattice.
Vec3 at(const VectorLattice& lattice, Vec3 m) {
  const Vec3 in = (m - lattice.low_m) / lattice.apart_m, low = glm::floor(in), part = in - low;
  Vec3 sum(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 step(corner & 1, corner >> 1 & 1, corner >> 2), p = low + step;
    const Vec3 weight = glm::mix(1.0 - part, part, step);
    const auto index = static_cast<std::size_t>((p.z * lattice.size[1] + p.y) * lattice.size[0] + p.x);
    sum += weight.x * weight.y * weight.z * lattice.vectors.at(index);
  }
  return sum;
}

TEST_F(VectorGrid, InCubesIsReadAtItsOwnVoxels) {
  const auto file = write("wind.vdb", {vectorGrid("wind", 0.25, {-2, 3, 1}, {5, 4, 3}, slanted)});
  const VectorLattice lattice = read(file);
  EXPECT_EQ(lattice.name, "wind");
  EXPECT_EQ(lattice.apart_m, 0.25);
  EXPECT_EQ(lattice.low_m, Vec3(-0.75, 0.5, 0.0));
  EXPECT_EQ(lattice.size, (std::array<std::int32_t, 3>{7, 6, 5}));
  EXPECT_FALSE(lattice.coarser);
  EXPECT_EQ(read_.name, "wind.vdb");
  EXPECT_EQ(read_.kind, "volume");
  EXPECT_EQ(read_.hash, sim::hashOf(tests::fileText(file)));
  std::size_t i = 0;
  for (int z = 0; z < 5; ++z) {
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 7; ++x, ++i) {
        const bool rim = x % 6 == 0 || y % 5 == 0 || z % 4 == 0;
        const Vec3 m = 0.25 * Vec3(x - 3, y + 2, z);
        EXPECT_EQ(lattice.vectors[i], rim ? Vec3(0.0) : Vec3(sim::Vec3f(slanted(m)))) << x << y << z;
      }
    }
  }
}

TEST_F(VectorGrid, OfDoublesAndOfTilesIsReadToo) {
  auto grid = vectorGrid<openvdb::Vec3DGrid>("v", 0.5, {0, 0, 0}, {1, 1, 1}, slanted);
  grid->fill(openvdb::CoordBBox({0, 0, 0}, {31, 15, 15}), {0.1, 0.2, 0.3});  // whole leaves, as tiles
  const VectorLattice lattice = read(write("tiles.vdb", {grid}));
  EXPECT_EQ(lattice.size, (std::array<std::int32_t, 3>{34, 18, 18}));
  EXPECT_LT(glm::distance(at(lattice, {0.0, 0.0, 0.0}), Vec3(0.1, 0.2, 0.3)), 1e-12);
  EXPECT_LT(glm::distance(at(lattice, {7.1, 3.3, 2.9}), Vec3(0.1, 0.2, 0.3)), 1e-12);
}

TEST_F(VectorGrid, InAnotherFrameLiesWhereItsTransformSays) {
  auto grid = openvdb::Vec3DGrid::create();
  auto transform = openvdb::math::Transform::createLinearTransform(0.1);
  transform->preScale(openvdb::Vec3d(1.0, 2.0, 1.5));
  transform->postRotate(0.5, openvdb::math::Z_AXIS);
  transform->postTranslate(openvdb::Vec3d(3.0, -1.0, 2.0));
  grid->setTransform(transform);
  for (int x = 0; x < 30; ++x) {
    for (int y = 0; y < 20; ++y) {
      for (int z = 0; z < 20; ++z) {
        const openvdb::Vec3d m = transform->indexToWorld(openvdb::Vec3d(x, y, z));
        const Vec3 v = slanted({m.x(), m.y(), m.z()});
        grid->tree().setValueOn({x, y, z}, {v.x, v.y, v.z});
      }
    }
  }
  const VectorLattice lattice = read(write("turned.vdb", {grid}));
  EXPECT_NEAR(lattice.apart_m, 0.1, 1e-12);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(3.0, 16.0);
  for (int i = 0; i < 200; ++i) {
    const openvdb::Vec3d index(1.5 * share(random), share(random), share(random));
    const openvdb::Vec3d m = transform->indexToWorld(index);
    const Vec3 place(m.x(), m.y(), m.z());
    EXPECT_LT(glm::distance(at(lattice, place), slanted(place)), 1e-9);
  }
}

TEST_F(VectorGrid, OfMorePointsIsHeldAtFewer) {
  auto grid = vectorGrid("v", 0.5, {0, 0, 0}, {1, 1, 1}, slanted);
  grid->fill(openvdb::CoordBBox({-512, 0, 0}, {511, 511, 255}), {0.0f, 1.0f, 0.0f});
  const VectorLattice lattice = read(write("large.vdb", {grid}));
  EXPECT_TRUE(lattice.coarser);
  EXPECT_LE(static_cast<std::int64_t>(lattice.vectors.size()), kMostLatticePoints);
  EXPECT_GT(static_cast<std::int64_t>(lattice.vectors.size()), kMostLatticePoints / 2);
  EXPECT_LT(glm::distance(at(lattice, {-200.0, 100.0, 60.0}), Vec3(0, 1, 0)), 1e-12);
  auto line = vectorGrid("v", 0.5, {0, 0, 0}, {1, 1, 1}, slanted);
  line->fill(openvdb::CoordBBox({0, 0, 0}, {99'999, 0, 0}), {0.0f, 1.0f, 0.0f});
  EXPECT_LE(read(write("line.vdb", {line})).size[0], kMostLatticeSide);
}

TEST_F(VectorGrid, IsTheOneOfTheName) {
  const auto up = [](Vec3) { return Vec3(0, 1, 0); };
  const auto along = [](Vec3) { return Vec3(1, 0, 0); };
  auto density = openvdb::FloatGrid::create();
  density->setName("density");
  density->tree().setValueOn({0, 0, 0}, 1.0f);
  const auto file = write("two.vdb", {density, vectorGrid("up", 1.0, {0, 0, 0}, {3, 3, 3}, up),
                                      vectorGrid("along", 1.0, {0, 0, 0}, {3, 3, 3}, along)});
  EXPECT_EQ(at(read(file, "up"), Vec3(1.0)), Vec3(0, 1, 0));
  EXPECT_EQ(at(read(file, "along"), Vec3(1.0)), Vec3(1, 0, 0));
  expectRefused(file, "there are 2 grids of vectors in the file: up, along; expected grid: NAME");
  expectRefused(file,
                "there is no grid 'alogn' in the file; expected one of up, along; did you mean 'along'?",
                "alogn");
  expectRefused(file, "the grid 'density' holds 'float'; expected vectors", "density");
  EXPECT_EQ(read(write("one.vdb", {density, vectorGrid("up", 1.0, {0, 0, 0}, {3, 3, 3}, up)})).name, "up");
  expectRefused(write("none.vdb", {density}), "there is no grid of vectors in the file");
}

TEST_F(VectorGrid, ThatCannotBeAnAxisIsRefused) {
  const auto refused = [&](const std::string& because,
                           const std::function<void(openvdb::Vec3SGrid&)>& change) {
    auto grid = vectorGrid("v", 1.0, {0, 0, 0}, {3, 3, 3}, slanted);
    change(*grid);
    expectRefused(write("bad.vdb", {grid}), because);
  };
  refused("the grid 'v': it has no active voxels", [](auto& grid) { grid.clear(); });
  refused("expected numbers from -1e+06 to 1e+06", [](auto& grid) {
    grid.tree().setValueOn({1, 1, 1}, openvdb::Vec3f(0, NAN, 0));
  });
  refused("expected numbers from -1e+06 to 1e+06", [](auto& grid) {
    grid.tree().setValueOn({1, 1, 1}, openvdb::Vec3f(0, 0, 2e6));
  });
  refused("its vectors are in voxel space", [](auto& grid) { grid.setIsInWorldSpace(false); });
  refused("its transform is not linear", [](auto& grid) {
    grid.setTransform(
        openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd({0, 0, 0}, {9, 9, 9}), 0.5, 2.0));
  });
  refused("expected places from -1e+06 to 1e+06 metres",
          [](auto& grid) { grid.transform().postTranslate(openvdb::Vec3d(2e6, 0, 0)); });
  refused("expected places from -1e+06 to 1e+06 metres", [](auto& grid) {
    grid.tree().addTile(3, {std::numeric_limits<int>::max() - 9000, 0, 0}, openvdb::Vec3f(1.0f), true);
  });
}

TEST_F(VectorGrid, FilesThatAreNone) {
  expectRefused(scratch_.path("missing.vdb"), "cannot open the volume: No such file");
  std::filesystem::create_directory(scratch_.path("folder.vdb"));
  expectRefused(scratch_.path("folder.vdb"), "is a folder, not a volume file");
  ASSERT_EQ(::mkfifo(scratch_.path("pipe.vdb").c_str(), 0600), 0);
  expectRefused(scratch_.path("pipe.vdb"), "not a regular file");
  expectRefused(scratch_.write("empty.vdb", ""), "the file is empty");
  expectRefused(scratch_.write("text.vdb", "a text of some length, which is no volume at all\n"),
                "the file is damaged or cut, or no OpenVDB file");
}

TEST_F(VectorGrid, ThatIsCutOrDamagedIsRefusedOrRead) {
  // With threads of this process at work before: none of them lives in the child.
  sim::parallelForEach(1000, [](std::size_t) {});
  const auto file = write("good.vdb", {vectorGrid("v", 0.5, {0, 0, 0}, {20, 20, 20}, [](Vec3 m) {
                            return Vec3(std::sin(m.x), std::cos(m.y), m.z);
                          })});
  const std::string good = tests::fileText(file);
  for (const double share : {0.01, 0.1, 0.5, 0.9, 0.99, 0.9999})
    expectRefused(
        scratch_.write("cut.vdb",
                       good.substr(0, static_cast<std::size_t>(share * static_cast<double>(good.size())))),
        "");
  std::mt19937 random(9);
  int refused = 0;
  for (int trial = 0; trial < 20; ++trial) {
    std::string bad = good;
    for (int i = 0; i < 3; ++i) {
      // Mostly where lengths, types and trees are described.
      const std::size_t place = random() % (trial % 2 == 0 ? 1200 : bad.size());
      bad[place] = static_cast<char>(random());
    }
    const auto path = scratch_.write("bad.vdb", bad);
    const std::string said = tests::messageOf([&] { read(path); });
    refused += said != "no error";
    EXPECT_TRUE(said == "no error" || said.starts_with(path.string() + ": ")) << said;
  }
  EXPECT_GT(refused, 3);
  EXPECT_EQ(read(file).size[0], 22);
}

TEST_F(VectorGrid, FromAChildThatWentWildIsRefused) {
  EXPECT_THROW(latticeFromChild("", read_), std::runtime_error);
  EXPECT_THROW(latticeFromChild(std::string(200, '\x7f'), read_), std::runtime_error);
}

}  // namespace
}  // namespace espalier::scenes
