#include "render/files/vdb.h"

#include <gtest/gtest.h>
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/world/band.h"
#include "tests/support/plots.h"
#include "tests/support/vdb.h"

namespace espalier {
namespace {

using sim::Voxel;

using tests::ReadBack;
using tests::readBack;

class Vdb : public testing::Test {
 protected:
  sim::World world_ = tests::wallPlot({30, 24, 20}, 3);
  sim::VoxelSet stands_{world_.occupied()};
  sim::VoxelSet near_{sim::freeBand(world_, world_.occupied(), 2)};

  static float number(Voxel v) { return static_cast<float>(v.x + 100 * v.y + 10000 * v.z); }
  /// One grid of each kind.
  std::vector<render::VdbField> fields() const {
    using Numbers = std::vector<render::VdbPart<float>>;
    const auto here = [](Voxel v, std::size_t) { return number(v); };
    return {{"place",
             "where it is",
             "1",
             Numbers{{&stands_, here}, {&near_, [](Voxel v, std::size_t) { return -number(v); }}},
             {{"weighting", "none"}}},
            {"count", "its number", "1",
             std::vector<render::VdbPart<std::int32_t>>{
                 {&near_, [](Voxel, std::size_t n) { return static_cast<std::int32_t>(n); }}}},
            {"way", "up", "1", std::vector<render::VdbPart<sim::Vec3f>>{{&stands_, [](Voxel v, std::size_t) {
                                                                           return sim::Vec3f(0, v.y, 1);
                                                                         }}}}};
  }

  template <class Check>
  void forEachVoxel(Check check) const {
    const Voxel size = world_.frame().size;
    for (int y = 0; y < size.y; ++y) {
      for (int z = 0; z < size.z; ++z) {
        for (int x = 0; x < size.x; ++x) check(Voxel(x, y, z), openvdb::Coord(x, y, z));
      }
    }
  }
};

TEST_F(Vdb, HoldsTheWorldVoxelForVoxel) {
  const ReadBack file = readBack(render::vdbBytes(world_));
  EXPECT_EQ(file.grids.size(), 8u);
  const auto density = file.grid<openvdb::FloatGrid>("density"),
             distance = file.grid<openvdb::FloatGrid>("distance"),
             coverage = file.grid<openvdb::FloatGrid>("coverage");
  const auto part = file.grid<openvdb::FloatGrid>("part"), layer = file.grid<openvdb::FloatGrid>("layer"),
             nearest = file.grid<openvdb::FloatGrid>("nearest");
  const auto colour = file.grid<openvdb::Vec3SGrid>("colour"),
             normal = file.grid<openvdb::Vec3SGrid>("normal");
  ASSERT_TRUE(density && distance && coverage && part && layer && nearest && colour && normal);
  std::size_t band = 0;
  forEachVoxel([&](Voxel v, openvdb::Coord at) {
    const bool occupied = world_.occupied().at(v);
    EXPECT_EQ(density->tree().getValue(at), occupied ? 1.0f : 0.0f);
    EXPECT_EQ(density->tree().isValueOn(at), occupied);
    EXPECT_EQ(part->tree().getValue(at), world_.partAt(v));
    if (const auto surface = world_.surfaceAt(v)) {
      EXPECT_EQ(coverage->tree().getValue(at), surface->coverage);
      EXPECT_EQ(colour->tree().getValue(at).x(), surface->colour.r);
      EXPECT_EQ(normal->tree().getValue(at).y(), surface->normal.y);
    }
    const auto near = world_.nearnessAt(v);
    EXPECT_EQ(layer->tree().isValueOn(at), near.has_value());
    if (near) {
      EXPECT_EQ(layer->tree().getValue(at), near->layer);
      EXPECT_EQ(nearest->tree().getValue(at), near->part);
      EXPECT_EQ(distance->tree().getValue(at), near->distance_vx);
      band += !occupied;
    }
  });
  EXPECT_GT(band, 1000u);
}

TEST_F(Vdb, FieldsAreActiveWhereTheyAreKnownAndNowhereElse) {
  const ReadBack file = readBack(render::fieldVdbBytes(world_, fields()));
  ASSERT_EQ(file.grids.size(), 3u);
  const auto place = file.grid<openvdb::FloatGrid>("place");
  const auto count = file.grid<openvdb::FloatGrid>("count");
  const auto way = file.grid<openvdb::Vec3SGrid>("way");
  ASSERT_TRUE(place && count && way);
  EXPECT_EQ(place->activeVoxelCount(), stands_.count() + near_.count());
  EXPECT_EQ(count->activeVoxelCount(), near_.count());
  EXPECT_EQ(way->activeVoxelCount(), stands_.count());
  EXPECT_EQ(place->metaValue<std::string>("weighting"), "none");
  forEachVoxel([&](Voxel v, openvdb::Coord at) {
    const float sign = stands_.has(v) ? 1.0f : near_.has(v) ? -1.0f : 0.0f;
    ASSERT_EQ(place->tree().getValue(at), sign * number(v));
    ASSERT_EQ(count->tree().isValueOn(at), near_.has(v));
    if (near_.has(v)) {
      ASSERT_EQ(count->tree().getValue(at), static_cast<int>(near_.number(v)));
    }
    if (stands_.has(v)) {
      ASSERT_EQ(way->tree().getValue(at), openvdb::Vec3f(0, static_cast<float>(v.y), 1));
    }
  });
}

TEST_F(Vdb, AGridMayHaveOneValueInAllElseThatIsOccupied) {
  std::vector<render::VdbField> one = fields();
  one.resize(1);
  one[0].elsewhere = 7.0f;
  one[0].parts =
      std::vector<render::VdbPart<float>>{{&near_, [](Voxel v, std::size_t) { return number(v); }}};
  const ReadBack file = readBack(render::vdbBytes(world_, one));
  const auto place = file.grid<openvdb::FloatGrid>("place");
  EXPECT_EQ(place->getGridClass(), openvdb::GRID_FOG_VOLUME);
  forEachVoxel([&](Voxel v, openvdb::Coord at) {
    const float expected = near_.has(v) ? number(v) : stands_.has(v) ? 7.0f : 0.0f;
    ASSERT_EQ(place->tree().getValue(at), expected);
    ASSERT_EQ(place->tree().isValueOn(at), near_.has(v) || stands_.has(v));
  });
}

TEST_F(Vdb, SaysWhatItHolds) {
  const ReadBack file = readBack(render::vdbBytes(world_));
  EXPECT_EQ(file.grids.size(), 8u);  // no exposure was given
  EXPECT_EQ(file.about->metaValue<std::string>("parts"), "1\tplot\tsoil\n2\tplot\tbrick\n");
  for (const auto& [name, grid] : file.grids) {
    EXPECT_EQ(grid->getCreator(), "Espalier");
    EXPECT_FALSE(grid->metaValue<std::string>("description").empty()) << name;
    EXPECT_EQ(grid->metaValue<double>("voxel_m"), world_.frame().voxel_m);
    const sim::Vec3 expected = sim::worldFromVoxel(world_.frame(), {3, 5, 7});
    const openvdb::Vec3d found = grid->transform().indexToWorld(openvdb::Coord(3, 5, 7));
    EXPECT_NEAR(glm::distance(expected, sim::Vec3(found.x(), found.y(), found.z())), 0.0, 1e-12) << name;
  }
  EXPECT_EQ(file.grids.at("density")->getGridClass(), openvdb::GRID_FOG_VOLUME);
  EXPECT_EQ(file.grids.at("distance")->metaValue<std::string>("unit"), "voxel widths");
}

TEST_F(Vdb, TheSameBytesOnAnyNumberOfThreads) {
  const auto write = [&](int threads) {
    std::string bytes;
    sim::onThreads(threads, [&] { bytes = render::vdbBytes(tests::wallPlot({30, 24, 20}, 3), fields()); });
    return bytes;
  };
  const std::string one = write(1);
  EXPECT_EQ(one, write(1));
  EXPECT_EQ(one, write(5));
  EXPECT_NE(one, render::vdbBytes(tests::wallPlot({30, 24, 20}, 2), fields()));  // a layer less would show
}

TEST_F(Vdb, TheFileIdIsAUuidAndFollowsFromTheContents) {
  const std::string with = render::vdbBytes(world_, fields()), without = render::vdbBytes(world_);
  const auto id = [](const std::string& bytes) { return bytes.substr(21, 36); };
  for (const std::string& text : {id(with), id(without)}) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
      EXPECT_TRUE(dash ? text[i] == '-' : std::isxdigit(static_cast<unsigned char>(text[i])) != 0) << text;
    }
  }
  EXPECT_NE(id(with), id(without));
}

TEST_F(Vdb, AFieldOfAnotherSizeIsRefused) {
  const sim::VoxelSet small{sim::BitVolume(Voxel(2))};
  const render::VdbField field{
      "small", "", "1",
      std::vector<render::VdbPart<float>>{{&small, [](Voxel, std::size_t) { return 0.0f; }}}};
  EXPECT_THROW(render::vdbBytes(world_, {field}), sim::InputError);
}

TEST_F(Vdb, SaysByWhatAndFromWhatItWasMade) {
  const sim::Provenance made_by{"Espalier 9.8.7", 9007199254740991u, {{"s.yaml", "scene", 0xabcu}}};
  for (const std::string& bytes :
       {render::vdbBytes(world_, {}, made_by), render::fieldVdbBytes(world_, fields(), made_by)}) {
    const ReadBack file = readBack(bytes);
    EXPECT_EQ(file.about->metaValue<std::string>("software"), "Espalier 9.8.7");
    EXPECT_EQ(file.about->metaValue<std::int64_t>("seed"), 9007199254740991);
    EXPECT_EQ(file.about->metaValue<std::string>("inputs"), "0000000000000abc scene s.yaml");
  }
}

}  // namespace
}  // namespace espalier
