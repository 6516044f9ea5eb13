#include "scenes/read/read_scene.h"

#include <gtest/gtest.h>

#include "rules/language/colour.h"
#include "sim/base/hasher.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

using tests::Scratch;

Scene goodScene(const std::filesystem::path& path) {
  auto result = readScene(path);
  EXPECT_TRUE(result) << format(result.problems());
  return result ? *result : Scene{};
}

TEST(ReadScene, ReadsTheGardenWall) {
  const auto file = tests::sourceFolder() / "scenes/library/garden_wall.yaml";
  const auto scene = goodScene(file);
  EXPECT_EQ(scene.name, "garden_wall");
  EXPECT_EQ(scene.file, file);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].file, tests::sourceFolder() / "scenes/meshes/garden_wall.obj");
  EXPECT_EQ(scene.world.voxel_m, 0.04);
  ASSERT_TRUE(scene.world.bounds_m);
  const auto voxels = ((*scene.world.bounds_m)[1] - (*scene.world.bounds_m)[0]) / *scene.world.voxel_m;
  EXPECT_NEAR(voxels.x, 165, 1e-9);
  EXPECT_NEAR(voxels.y, 150, 1e-9);
  EXPECT_NEAR(voxels.z, 195, 1e-9);
  EXPECT_EQ(scene.world.layers, 4);
  EXPECT_EQ(scene.iterations, 51);
  std::size_t seeds = 0;
  for (const auto& plant : scene.plants) {
    seeds += plant.seeds.size();
    ASSERT_TRUE(plant.rules);
  }
  EXPECT_EQ(seeds, 17u);
  EXPECT_EQ(scene.image_width, 1280);
  EXPECT_EQ(scene.image_height, 960);
}

TEST(ReadScene, ReadsEveryPart) {
  const Scratch scratch;
  scratch.write("meshes/wall.obj", "");
  scratch.write("rules/vine.yaml", "espalier: rules\nname: the vine\n");
  const auto scene = goodScene(scratch.write("scenes/s.yaml", R"(espalier: scene/1
meshes:
  - ../meshes/wall.obj
  - {file: missing.glb, optional: true, name: ruin, regions: material, solid: true, scale: 0.01, rotate: [0, 90, 0],
     translate: [1, 20 cm, "-3 m"], colour: "#ffffff"}
world: {resolution: 200, margin: 50 cm, layers: 6}
sky: {weighting: cosine, directions: 500}
sun: {tilt: 10, toward: 90, samples: 12, shadow_hour: 9.5}
plants:
  - {rules: ../rules/vine.yaml, seeds: [[0, 0, 0], [1 m, 2 cm, 3 mm], {at: [2, 1 cm, 0], key: north door}]}
  - {rules: {name: here, bias: {up: 1}}, name: fern, scatter: {region: the bed, count: 40}}
iterations: 7
seed: 9007199254740991
image: {width: 320, height: 240}
cameras:
  front: {eye: [0, 1, 5], target: [0, 1, 0], fov: 50}
  above: {eye: [0, 9, 0.1], target: [0, 0, 0]}
images:
  - vines
  - {kind: section, axis: x, at: 120 cm, name: cut, caption: A cut}
  - {kind: contact_sheet, of: [vines, cut], camera: above}
)"));
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0].name, "wall");
  EXPECT_EQ(scene.meshes[0].file, scratch.path("meshes/wall.obj"));
  const auto& ruin = scene.meshes[1];
  EXPECT_EQ(ruin.name, "ruin");
  EXPECT_EQ(ruin.regions_from, RegionsFrom::material);
  EXPECT_TRUE(ruin.solid && ruin.optional);
  EXPECT_EQ(ruin.placement.scale, 0.01);
  EXPECT_EQ(ruin.placement.rotate_deg, sim::Vec3(0, 90, 0));
  EXPECT_EQ(ruin.placement.translate_m, sim::Vec3(1, 0.2, -3));
  EXPECT_EQ(rules::hexFromLinear(*ruin.colour), "#ffffff");
  EXPECT_EQ(scene.world.resolution, 200);
  EXPECT_FALSE(scene.world.voxel_m || scene.world.bounds_m);
  EXPECT_EQ(scene.world.margin_m, 0.5);
  EXPECT_EQ(scene.world.layers, 6);
  ASSERT_EQ(scene.plants.size(), 2u);
  EXPECT_EQ(scene.plants[0].rules_place.line, 10);
  EXPECT_EQ(scene.plants[0].rules_place.column, 13);
  EXPECT_EQ(scene.sky.weighting, sim::Weighting::cosine);
  EXPECT_EQ(scene.sky.directions, 500);
  EXPECT_EQ(scene.sun.toward_deg, 90);
  EXPECT_EQ(scene.sun.shadow_hour, 9.5);
  ASSERT_EQ(scene.plants.size(), 2u);
  EXPECT_EQ(scene.plants[0].name, "plant_1");
  EXPECT_EQ(scene.plants[0].rules->name, "the vine");
  EXPECT_EQ(scene.plants[0].rules_file, scratch.path("rules/vine.yaml"));
  ASSERT_EQ(scene.plants[0].seeds.size(), 3u);
  EXPECT_EQ(scene.plants[0].seeds[1].at_m, sim::Vec3(1, 0.02, 0.003));
  EXPECT_EQ(scene.plants[0].seeds[1].key, "");
  EXPECT_EQ(scene.plants[0].seeds[2].at_m, sim::Vec3(2, 0.01, 0));
  EXPECT_EQ(scene.plants[0].seeds[2].key, "north door");
  EXPECT_EQ(scene.plants[1].rules->bias.up, rules::Value(1));
  EXPECT_EQ(scene.plants[1].scatter->region, "the bed");
  EXPECT_EQ(scene.plants[1].scatter->count, 40);
  EXPECT_EQ(scene.iterations, 7);
  EXPECT_EQ(scene.seed, 9007199254740991u);
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "front") << "cameras keep the order of the file";
  EXPECT_EQ(scene.cameras[0].camera.fov_deg, 50);
  ASSERT_EQ(scene.images.size(), 3u);
  EXPECT_EQ(scene.images[0].name, "vines");
  EXPECT_EQ(scene.images[1].name, "cut");
  EXPECT_EQ(scene.images[1].axis, 'x');
  EXPECT_EQ(scene.images[1].at_m, 1.2);
  EXPECT_EQ(scene.images[2].of, (std::vector<std::string>{"vines", "cut"}));
}

TEST(ReadScene, ReadsARealSunAndARandomSky) {
  using namespace std::chrono_literals;
  const Scratch scratch;
  const auto read = [&](const std::string& sun) {
    return goodScene(
        scratch.write("s.yaml",
                      "espalier: scene\nworld: {voxel: 1 cm, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\n"
                      "sky: {weighting: cie_overcast, sampling: random, rays: 50}\n"
                      "sun:\n  place: {latitude: -33.87, longitude: 151.22, utc_offset: 10}\n" +
                          sun));
  };
  const auto range = read(
      "  dates: {from: 2026-03-21, to: 2026-09-23}\n  hours: {from: 9, to: 15.5}\n  step: 30\n"
      "  weighting: sine\n  north: 12\n  accuracy: 1\n");
  EXPECT_EQ(range.sky.weighting, sim::Weighting::cie_overcast);
  EXPECT_EQ(range.sky.sampling, Sampling::random);
  EXPECT_EQ(range.sky.rays, 50);
  ASSERT_TRUE(range.sun.place && range.sun.dates);
  EXPECT_EQ(range.sun.place->latitude_deg, -33.87);
  EXPECT_EQ(range.sun.place->longitude_deg, 151.22);
  EXPECT_EQ(range.sun.place->utc_offset_h, 10);
  EXPECT_EQ(range.sun.dates->from, 2026y / 3 / 21);
  EXPECT_EQ(range.sun.dates->to, 2026y / 9 / 23);
  EXPECT_EQ(range.sun.hours.from, 9);
  EXPECT_EQ(range.sun.hours.to, 15.5);
  EXPECT_EQ(range.sun.step_min, 30);
  EXPECT_EQ(range.sun.weighting, sim::SunWeighting::sine);
  EXPECT_EQ(range.sun.north_deg, 12);
  EXPECT_EQ(range.sun.accuracy_deg, 1);
  EXPECT_EQ(read("  date: 12-21\n").sun.date, 2017y / 12 / 21) << "the year of the common tables";
}

TEST(ReadScene, NeedsNoMeshWhereBoundsAreGiven) {
  const Scratch scratch;
  const auto scene = goodScene(scratch.write(
      "s.yaml", "espalier: scene\nworld: {voxel: 1 cm, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\n"));
  EXPECT_TRUE(scene.meshes.empty());
}

TEST(ReadScene, ReportsTheProblemsOfTheSceneAndOfItsRulesTogether) {
  const Scratch scratch;
  scratch.write("vine.yaml", "espalier: rules\nbias: {upp: 1}\nlight: {boost: fast}\n");
  const auto shown = scratch.shown(
      readScene(
          scratch.write(
              "s.yaml",
              "espalier: scene\nworld: {voxel: 4 inch}\nplants:\n  - {rules: vine.yaml, seeds: [[0, 0]]}\n"
              "  - {rules: vine.yaml, seeds: [[0, 0, 0]], nmae: x}\n"))
          .problems());
  EXPECT_EQ(std::count(shown.begin(), shown.end(), '\n'), 5) << shown;
  for (const char* message :
       {"s.yaml:2:16: world.voxel is '4 inch'", "s.yaml:4:32: plants[0].seeds[0].at has a list of 2",
        "s.yaml:5:44: unknown key 'nmae'", "s.yaml:1:1: no mesh and no world.bounds",
        "vine.yaml:2:8: unknown key 'upp'", "vine.yaml:3:16: light.boost is 'fast'"}) {
    EXPECT_NE(shown.find(message), shown.npos) << message << "\n" << shown;
  }
}

TEST(ReadScene, SaysWhatIsWrongWithTheFileItself) {
  const Scratch scratch;
  EXPECT_EQ(scratch.shown(readScene(scratch.path("none.yaml")).problems()),
            "none.yaml: cannot be opened (No such file or directory); expected a readable file");
  EXPECT_EQ(scratch.shown(readScene(scratch.write("r.yaml", "espalier: rules\n")).problems()),
            "r.yaml:1:11: this is a rule file; expected a scene file (espalier: scene)");
}

TEST(ReadScene, RemembersEveryFileThatItReadWithTheHashOfItsBytes) {
  const Scratch scratch;
  const std::string away =
      scratch.write("away/ivy.yaml", "espalier: rules\nbase: deep/under.yaml\n").string();
  scratch.write("away/deep/under.yaml", "espalier: rules\n");
  scratch.write("garden/plants/ivy.yaml",
                "espalier: rules\nbase: ../base.yaml\notherwise: dim.yaml\nregions: {wall: brick.yaml}\n");
  const std::string base =
      "\xef\xbb\xbf"
      "espalier: rules\n";
  const std::string here = scratch.write("garden/base.yaml", base).string();
  scratch.write("garden/plants/dim.yaml", "espalier: rules\n");
  scratch.write("garden/plants/brick.yaml", "espalier: rules\nbase: ../base.yaml\n");
  scratch.write("shared.yaml", "espalier: rules\n");
  const std::string seeds = "seeds: [[0.5, 0.5, 0.5]]}\n";
  const auto scene = goodScene(scratch.write(
      "garden/s.yaml",
      "espalier: scene\nworld: {voxel: 0.1, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\nplants:\n"
      "  - {name: a, rules: plants/ivy.yaml, " +
          seeds + "  - {name: b, rules: {base: " + here + "}, " + seeds + "  - {name: c, rules: " + away +
          ", " + seeds + "  - {name: d, rules: ../shared.yaml, " + seeds));
  std::vector<std::string> names;
  for (const auto& file : scene.read_files) names.push_back(file.kind + " " + file.name);
  // What is written from the machine's root and lies elsewhere is called by its last name.
  EXPECT_EQ(names, (std::vector<std::string>{"scene s.yaml", "rules plants/ivy.yaml", "rules base.yaml",
                                             "rules plants/dim.yaml", "rules plants/brick.yaml",
                                             "rules ivy.yaml", "rules under.yaml", "rules ../shared.yaml"}));
  EXPECT_EQ(scene.read_files.at(2).hash, sim::hashOf(base));
  EXPECT_EQ(scene.read_files[0].hash, sim::hashOf(tests::fileText(scratch.path("garden/s.yaml"))));
}

}  // namespace
}  // namespace espalier::scenes
