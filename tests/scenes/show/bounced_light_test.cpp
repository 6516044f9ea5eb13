#include "scenes/show/bounced_light.h"

#include <gtest/gtest.h>

#include "render/voxels/panels.h"
#include "scenes/job/expose.h"
#include "scenes/prepare/site.h"
#include "scenes/read/read_scene.h"
#include "scenes/show/voxel_colours.h"
#include "sim/base/faces.h"
#include "tests/support/scratch.h"
#include "tests/support/worlds.h"

namespace espalier::scenes {
namespace {

using sim::Colour;
using sim::Vec3;
using sim::Vec3f;

/// A white floor of 3 m with a red wall across it, and a lamp before the wall.
class RedWall : public testing::Test {
 protected:
  static constexpr const char* kMesh =
      "mtllib wall.mtl\nusemtl white\n"
      "v 0 0 0\nv 3 0 0\nv 3 0 3\nv 0 0 3\nf 1 4 3 2\n"
      "usemtl red\nv 0 0.05 1\nv 3 0.05 1\nv 3 1.5 1\nv 0 1.5 1\nf 5 6 7 8\n";
  static constexpr const char* kLamp =
      "mtllib wall.mtl\nusemtl lamp\nv 1.4 0.5 1.4\nv 1.6 0.5 1.4\nv 1.6 0.5 1.6\nv 1.4 0.5 1.6\n"
      "v 1.4 0.7 1.4\nv 1.6 0.7 1.4\nv 1.6 0.7 1.6\nv 1.4 0.7 1.6\n"
      "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

  RedWall() {
    folder_.write(
        "wall.mtl",
        "newmtl white\nKd 0.9 0.9 0.9\nnewmtl red\nKd 0.9 0.1 0.1\nnewmtl lamp\nKd 0.5 0.5 0.5\nKe 1 1 1\n");
    folder_.write("wall.obj", kMesh);
    folder_.write("lamp.obj", kLamp);
  }

  Scene scene(const std::string& meshes, const std::string& more = "interreflection: {directions: 64}") {
    folder_.write("scene.yaml", "espalier: scene\nmeshes: [" + meshes +
                                    "]\nworld: {voxel: 6 cm, margin: 12 cm}\nsky: {directions: 64}\n" + more +
                                    "\n");
    auto read = readScene(folder_.path("scene.yaml"));
    if (!read) throw std::runtime_error(format(read.problems()));
    return *read;
  }

  struct Found {
    Scene scene;
    Site site;
    sim::Lighting light;
    PictureLight lit;
  };
  static std::unique_ptr<Found> find(Scene scene, Vec3 to_sun) {
    auto found = std::make_unique<Found>(Found{scene, makeSite(scene), {}, {}});
    sim::LightWanted wanted;
    wanted.to_sun = to_sun;
    found->light = sim::lightOf(found->site.world, found->site.sky, found->site.sun, wanted);
    found->lit = pictureLight(found->scene, found->site.meshes, found->site.world, {}, found->light,
                              {.first_pass = true, .vines = true}, to_sun);
    return found;
  }

  tests::Scratch folder_;
};

const Vec3 kSun = glm::normalize(Vec3(0.1, 1.0, 0.7));

TEST_F(RedWall, ReddensTheFloorBeforeItAndNotWhatIsFar) {
  const auto found = find(scene("wall.obj"), kSun);
  const sim::Frame& frame = found->site.world.frame();
  const auto on_floor = [&](double z) {
    return found->lit.vines->at(sim::voxelFromWorld(frame, Vec3(1.5, 0.0, z)), Vec3f(0, 1, 0));
  };
  const Colour near = on_floor(1.15), far = on_floor(2.9);
  EXPECT_GT(near.r, 3.0f * near.b);
  EXPECT_GT(near.r, 4.0f * far.r);
  // The wall gets light from the sunlit floor, the more the lower.
  const auto on_wall = [&](double y) {
    return found->lit.vines->at(sim::voxelFromWorld(frame, Vec3(1.5, y, 1.0)), Vec3f(0, 0, 1));
  };
  EXPECT_GT(on_wall(0.2).g, 1.2f * on_wall(1.4).g);
  // What a face receives is the sky's light and what has bounced.
  const sim::Voxel v = sim::voxelAt(sim::voxelFromWorld(frame, Vec3(1.5, 0.0, 2.9)));
  const render::FirstPassLight outdoors = render::firstPassLight();
  EXPECT_NEAR(found->lit.first_pass->ambientAtFace(v, 3, 2), outdoors.sky.b, 0.1f * outdoors.sky.b);
  EXPECT_FALSE(found->lit.emitted);
  EXPECT_NE(found->light.about.interreflection.find("128 directions over the sphere"), std::string::npos);
}

TEST_F(RedWall, ReddensDicedModelsToo) {
  const auto bounced = find(scene("wall.obj"), kSun), plain = find(scene("wall.obj", ""), kSun);
  const auto redness = [](const Found& found, double z) {
    const sim::World& world = found.site.world;
    const VoxelColours colours(world, world.occupied(), found.light, found.lit, ImageKind::first_pass, kSun);
    const Colour c =
        colours.at(sim::voxelAt(sim::voxelFromWorld(world.frame(), Vec3(1.5, 0.0, z))), sim::PartKind::scene);
    return c.r / c.b;
  };
  const auto redder = [&](double z) { return redness(*bounced, z) / redness(*plain, z); };
  EXPECT_GT(redder(1.15), 1.03f) << "before the wall";
  EXPECT_LT(redder(2.9) - 1.0f, 0.5f * (redder(1.15) - 1.0f)) << "far from it";
}

TEST_F(RedWall, StemsAndElementsSendOutAsMuchAsThereIsOfThem) {
  sim::World world = makeSite(scene("wall.obj", "")).world;
  sim::Plant plant;
  plant.stem_emits = Colour(4.0f, 2.0f, 0.0f);
  plant.shapes.resize(2);
  plant.shapes[1].emits = Colour(0.0f, 0.0f, 6.0f);
  plant.stem_part = world.addPart(tests::stemPart("vine"));
  for (int i = 0; i < 2; ++i) plant.element_parts.push_back(world.addPart(tests::elementPart("vine")));
  const auto put = [&](sim::Voxel v, sim::PartId part, float coverage) {
    world.occupy(std::vector<sim::TiledVoxel>{{v, {.part = part, .coverage = coverage}}});
  };
  put({20, 10, 30}, plant.stem_part, 0.25f);
  put({22, 10, 30}, plant.stem_part, 2.5f);
  put({24, 10, 30}, plant.element_parts[0], 1.0f);
  put({26, 10, 30}, plant.element_parts[1], 0.5f);
  const EmittedLight emitted({}, world, {plant});
  EXPECT_TRUE(emitted.any());
  EXPECT_EQ(emitted.at({20, 10, 30}), Colour(1.0f, 0.5f, 0.0f));
  EXPECT_EQ(emitted.at({22, 10, 30}), plant.stem_emits) << "no more than all of it";
  EXPECT_EQ(emitted.at({24, 10, 30}), Colour(0.0f));
  EXPECT_EQ(emitted.at({26, 10, 30}), Colour(0.0f, 0.0f, 3.0f));
  EXPECT_FALSE(EmittedLight({}, world, {}).any());
}

/// A stem that takes a tenth of its voxels, ten times as bright, lights the floor as one that fills them.
TEST_F(RedWall, WhatIsThinShinesFromAllOfItsVoxels) {
  std::vector<Colour> light;
  for (const float coverage : {1.0f, 0.1f}) {
    const Scene of = scene("wall.obj");
    Site site = makeSite(of);
    sim::World& world = site.world;
    sim::Plant plant;
    plant.stem_emits = Colour(5.0f / coverage);
    plant.stem_part = world.addPart(tests::stemPart("bolt"));
    std::vector<sim::TiledVoxel> stem;
    for (int y = 4; y < 20; ++y)
      stem.push_back({{30, y, 35}, {.part = plant.stem_part, .coverage = coverage}});
    world.occupy(stem);
    const std::vector<sim::Plant> plants{plant};
    letBeMet(world, plants);
    sim::LightWanted wanted;
    wanted.to_sun = kSun;
    const sim::Lighting found = sim::lightOf(world, site.sky, site.sun, wanted);
    GrowingBounce bounce(of, site.meshes, world, plants, found, kSun);
    ASSERT_TRUE(bounce.anyShines());
    const sim::BitVolume none(world.frame().size);
    const auto all = bounce.when(world.occupied()), before = bounce.when(none);
    for (const double x : {18.0, 24.0, 36.0}) {
      const Vec3 at(x, 2.0, 33.0);
      light.push_back(all->at(at, Vec3f(0, 1, 0)) - before->at(at, Vec3f(0, 1, 0)));
      EXPECT_GT(light.back().g, 0.05f);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(light[i].g, light[i + 3].g, 0.03f * light[i].g) << i;
}

/// The limb that leaves the upright one sends out a quarter of its light.
TEST_F(RedWall, StemsSendOutLessWithEachOrderOfBranching) {
  sim::World world = makeSite(scene("wall.obj", "")).world;
  sim::Plant plant;
  plant.stem_emits = Colour(4.0f);
  plant.stem_emits_share = 0.25f;
  plant.stem_part = world.addPart(tests::stemPart("bolt"));
  plant.skeleton.parent = {sim::kNoNode, 0, 1, 1};
  plant.skeleton.position_vx = {{20, 5, 30}, {20, 10, 30}, {20, 15, 30}, {25, 10, 30}};
  plant.skeleton.born = {0, 1, 2, 2};
  for (const sim::Voxel v : {sim::Voxel(20, 7, 30), {20, 13, 30}, {20, 10, 30}, {24, 10, 30}})
    world.occupy(std::vector<sim::TiledVoxel>{{v, {.part = plant.stem_part, .coverage = 1.0f}}});
  const EmittedLight emitted({}, world, {plant});
  EXPECT_EQ(emitted.at({20, 7, 30}), Colour(4.0f));
  EXPECT_EQ(emitted.at({20, 13, 30}), Colour(4.0f));
  EXPECT_EQ(emitted.at({20, 10, 30}), Colour(4.0f)) << "where they meet";
  EXPECT_EQ(emitted.at({24, 10, 30}), Colour(1.0f));
}

TEST_F(RedWall, WithoutInterreflectionNothingBounces) {
  const auto found = find(scene("wall.obj", ""), kSun);
  EXPECT_FALSE(found->lit.first_pass);
  EXPECT_FALSE(found->lit.vines);
  EXPECT_EQ(found->light.about.interreflection, "");
}

TEST_F(RedWall, ALampLightsWhatIsNear) {
  const std::string lamp = ", {file: lamp.obj, emits: {colour: \"#ffffff\", strength: 30}}";
  const auto dark = find(scene("wall.obj"), kSun), lit = find(scene("wall.obj" + lamp), kSun);
  const auto below = [](const Found& found) {
    return found.lit.vines->at(sim::voxelFromWorld(found.site.world.frame(), Vec3(1.5, 0.0, 1.5)),
                               Vec3f(0, 1, 0));
  };
  EXPECT_GT(below(*lit).g, below(*dark).g + 1.0f);
  ASSERT_TRUE(lit->lit.emitted);
  const sim::Frame& frame = lit->site.world.frame();
  EXPECT_NEAR(lit->lit.emitted->at(sim::voxelAt(sim::voxelFromWorld(frame, Vec3(1.5, 0.5, 1.5)))).g, 30.0f,
              0.5f);
  EXPECT_EQ(lit->lit.emitted->at(sim::voxelAt(sim::voxelFromWorld(frame, Vec3(0.5, 0.0, 2.5)))),
            Colour(0.0f));
  // Its own light, as the file has it.
  const auto own = find(scene("wall.obj, lamp.obj"), kSun);
  EXPECT_NEAR(own->lit.emitted->at(sim::voxelAt(sim::voxelFromWorld(frame, Vec3(1.5, 0.5, 1.5)))).g, 1.0f,
              0.05f);
}

TEST_F(RedWall, ALampIsSeenInMapsOfExposureWithAndWithoutWhatItLights) {
  const auto exposed = [&](const std::string& emits, const std::string& more) {
    const Scene asked =
        scene("wall.obj, {file: lamp.obj" + emits + "}",
              "image: {width: 60, height: 40}\ncameras: {a: {eye: [1.5, 1.2, 6], target: [1.5, "
              "0.6, 1.5], fov: 40}}\n" +
                  more);
    RunOptions options;
    options.folder = folder_.path("out");
    exposeScene(asked, options);
    const std::string png = tests::fileText(folder_.path("out/first_pass.png"));
    return png.substr(png.find("IDAT"));  // its header names the scene's light
  };
  const std::string dark = exposed(", emits: {strength: 0}", ""),
                    glows = exposed(", emits: {strength: 5}", ""),
                    lights = exposed(", emits: {strength: 5}", "interreflection: {directions: 16}\n");
  EXPECT_FALSE(dark == glows);
  EXPECT_FALSE(glows == lights);
}

TEST_F(RedWall, ALampInsideOfAWallIsRefused) {
  folder_.write("block.obj",
                "v 1 0.2 1.1\nv 2 0.2 1.1\nv 2 0.2 2\nv 1 0.2 2\nv 1 1 1.1\nv 2 1 1.1\nv 2 1 2\nv 1 1 2\n"
                "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
  const Scene buried = scene("{file: block.obj, solid: true}, lamp.obj");
  const Site site = makeSite(buried);
  try {
    requireLampsInTheOpen(buried, site);
    FAIL() << "a lamp in a block was taken";
  } catch (const PlacedError& error) {
    ASSERT_EQ(error.problems().size(), 1u);
    const std::string said = format(error.problems());
    EXPECT_NE(
        said.find(
            "scene.yaml:2:42: mesh 'lamp' sends out light, and none gets out: it lies inside of 'block'; "
            "expected it in the open"),
        std::string::npos)
        << said;
  }
  const Scene open = scene("wall.obj, lamp.obj");
  EXPECT_NO_THROW(requireLampsInTheOpen(open, makeSite(open)));
}

}  // namespace
}  // namespace espalier::scenes
