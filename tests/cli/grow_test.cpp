// The program as a user runs it: what it writes, and from what.
#include <gtest/gtest.h>

#include <OpenImageIO/imageio.h>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "scenes/import/mesh_import.h"
#include "sim/base/hasher.h"
#include "sim/base/provenance.h"
#include "tests/cli/plot.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using tests::Plot;

TEST_F(Plot, WritesTheModelTheWorldThePicturesAndTheReport) {
  const auto ran = grow();
  ASSERT_EQ(ran.status, 0) << ran.output;
  std::set<std::string> names;
  for (const auto& [name, bytes] : files(scratch_.path("out"))) {
    names.insert(name);
    EXPECT_GT(bytes.size(), 500u) << name;
    EXPECT_NE(ran.output.find(name), std::string::npos) << "the program does not name " << name;
  }
  for (const char* name :
       {"plant.glb", "skeleton.json", "world.vdb", "report.json", "vines.png", "sun_exposure.png",
        "sun_exposure.exr", "sky_exposure.png", "sky_exposure.exr", "threshold.png", "shadow_matte.png",
        "surface_colour.png", "first_pass.png", "section.png", "contact_sheet.png"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  const json r = report();
  EXPECT_GT(r["growth"]["buds"]["grown"].get<int>(), 30);
  EXPECT_EQ(r["growth"]["plants"].size(), 2u);
  EXPECT_EQ(r["world"]["size"], json({44, 32, 44}));
  EXPECT_EQ(r["files"].size(), names.size());
  EXPECT_GT(r["run"]["peak_memory_bytes"].get<double>(), 1e6);
}

std::vector<float> pixelsOf(const fs::path& picture) {
  const auto input = OIIO::ImageInput::open(picture.string());
  if (!input) throw std::runtime_error("cannot read " + picture.string());
  std::vector<float> pixels(static_cast<std::size_t>(input->spec().image_pixels()) *
                            static_cast<std::size_t>(input->spec().nchannels));
  if (!input->read_image(0, 0, 0, input->spec().nchannels, OIIO::TypeDesc::FLOAT, pixels.data()))
    throw std::runtime_error(input->geterror());
  return pixels;
}

TEST_F(Plot, APictureOfTheSceneAloneIsLitAsIfNothingGrew) {
  std::string scene = tests::kPlotScene;
  scene =
      scene.substr(0, scene.find("images:")) +
      "images: [vines, {kind: vines, name: bare, show: [scene]}, {kind: vines, name: limbs, show: [scene, "
      "stems]}]\n";
  const auto grown = [&](const std::string& iterations, const std::string& folder) {
    std::string text = scene;
    text.replace(text.find("iterations: 14"), 14, "iterations: " + iterations);
    scratch_.write("scene.yaml", text);
    const auto ran = grow("", folder);
    EXPECT_EQ(ran.status, 0) << ran.output;
  };
  grown("14", "many");
  grown("1", "few");
  const auto same = [&](const std::string& picture) {
    return pixelsOf(scratch_.path("many") / picture) == pixelsOf(scratch_.path("few") / picture);
  };
  EXPECT_TRUE(same("bare.png"));
  EXPECT_FALSE(same("limbs.png"));
  EXPECT_FALSE(same("vines.png"));
}

TEST_F(Plot, SaysWhatBecameOfAttractorsAndWhyGrowthEnded) {
  scratch_.write(
      "vine.yaml",
      "espalier: rules\npropagate: colonization\ncolonization: {crown: {sphere: 30 cm, trunk: 10 cm, count: "
      "40}}\n");
  const auto attractors = [&](const std::string& options, const std::string& folder) {
    const auto ran = grow("--no-pictures " + options, folder);
    EXPECT_EQ(ran.status, 0) << ran.output;
    const json all = report(folder)["growth"]["attractors"];
    EXPECT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0]["name"], "crown of vine");
    EXPECT_NE(ran.output.find("attractors 'crown of vine': " + all[0]["ending"].get<std::string>() + "\n"),
              std::string::npos)
        << ran.output;
    return all[0];
  };
  const json whole = attractors("--iterations 300", "whole");
  EXPECT_GT(whole["reached"].get<int>(), 30) << whole;
  EXPECT_EQ(whole["ending"].get<std::string>().find("iterations ended"), std::string::npos) << whole;
  const json part = attractors("--iterations 2", "part");
  EXPECT_GT(part["waiting"].get<int>(), 10) << part;
  EXPECT_EQ(part["ending"].get<std::string>().find("the iterations ended while "), 0u) << part;
}

TEST_F(Plot, AFieldMayBendAFrontThatGrowsToItsOwnCrown) {
  scratch_.write(
      "vine.yaml",
      "espalier: rules\npropagate: colonization\ncolonization: {crown: {sphere: 30 cm, trunk: 10 cm, "
      "count: 40}, fields: [whorl]}\n");
  scratch_.write("scene.yaml",
                 std::string(tests::kPlotScene) + "fields: {whorl: {angle: 360, strength: 2}}\n");
  const auto ran = grow("--no-pictures");
  ASSERT_EQ(ran.status, 0) << ran.output;
  const json fields = report()["growth"]["fields"];
  ASSERT_EQ(fields.size(), 1u);
  EXPECT_EQ(fields[0]["grid"], "field whorl");
  EXPECT_GT(fields[0]["voxels"].get<int>(), 500);
}

TEST_F(Plot, EveryByteIsTheSameOnOneTwoAndFiveThreads) {
  for (const int threads : {1, 2, 5}) {
    const std::string folder = "out" + std::to_string(threads);
    const auto ran = grow("--threads " + std::to_string(threads), folder);
    ASSERT_EQ(ran.status, 0) << ran.output;
  }
  auto one = files(scratch_.path("out1"));
  json first = report("out1");
  first.erase("run");  // timings and memory
  for (const char* folder : {"out2", "out5"}) {
    json other = report(folder);
    other.erase("run");
    EXPECT_EQ(first, other);
    for (const auto& [name, bytes] : files(scratch_.path(folder))) {
      if (name == "report.json") continue;
      EXPECT_TRUE(one[name] == bytes) << folder << '/' << name;
    }
  }
  // Another seed shows in the report and in every file that shows what grew.
  ASSERT_EQ(grow("--seed 6", "other").status, 0);
  json other = report("other");
  other.erase("run");
  EXPECT_NE(first, other);
  const auto others = files(scratch_.path("other"));
  for (const char* name : {"plant.glb", "skeleton.json", "world.vdb", "growth.state", "vines.png",
                           "sky_exposure.png", "sky_exposure.exr"})
    EXPECT_FALSE(one.at(name) == others.at(name)) << name;
}

TEST_F(Plot, EveryFileSaysFromWhatItWasMadeAndNotWhere) {
  const std::string far_off = std::string(tests::kPlotScene)
                                  .replace(std::string(tests::kPlotScene).find("[0.3, 0.1, 0.1]"), 15,
                                           "{at: [0.9, 1.4, 1.0], key: far off}");
  for (const char* folder : {"one", "another/place"}) {
    for (const char* name : {"plot.obj", "vine.yaml"})
      scratch_.write(std::string(folder) + "/" + name, tests::fileText(scratch_.path(name)));
    scratch_.write(std::string(folder) + "/scene.yaml", far_off);
  }
  const std::string root = scratch_.path("").string();
  for (const auto& [started, scene, out] :
       {std::tuple{root + "one", std::string("scene.yaml"), root + "a"},
        {std::string("/"), root + "another/place/scene.yaml", root + "b"}}) {
    const auto ran =
        tests::run("cd " + started + " && " + ESPALIER_PROGRAM + " grow " + scene + " -o " + out);
    ASSERT_EQ(ran.status, 0) << ran.output;
    EXPECT_NE(ran.output.find("note: 'vine 2' did not grow: "), std::string::npos) << ran.output;
    const json r = report(fs::path(out).filename().string());
    EXPECT_EQ(r["run"]["scene"], scene);
    EXPECT_EQ(r["seed"], 5);
    EXPECT_TRUE(r["software"].get<std::string>().starts_with("Espalier "));
    ASSERT_EQ(r["inputs"].size(), 3u);
    EXPECT_EQ(
        r["inputs"][2],
        json({{"file", "plot.obj"}, {"kind", "mesh"}, {"xxh3", sim::hexOf(sim::hashOf(tests::kPlotMesh))}}));
    const json plants = r["growth"]["plants"];
    ASSERT_EQ(plants.size(), 2u);
    EXPECT_FALSE(plants[0].contains("failed"));
    EXPECT_GT(plants[0]["buds"]["grown"], 10);
    EXPECT_EQ(plants[1]["seed"]["key"], "far off");
    EXPECT_NEAR(plants[1]["seed"]["at_m"][1].get<double>(), 1.4, 1e-9);
    EXPECT_EQ(plants[1]["segments"], 0);
    EXPECT_EQ(plants[1]["planting"], "vine");
    EXPECT_NE(ran.output.find(plants[1]["failed"].get<std::string>()), std::string::npos) << ran.output;
    for (const char* name : {"vines.png", "sky_exposure.png", "sky_exposure.exr", "contact_sheet.png"}) {
      const auto in = OIIO::ImageInput::open(out + "/" + name);
      ASSERT_TRUE(in) << name;
      EXPECT_EQ(in->spec().get_string_attribute("Software"), r["software"].get<std::string>()) << name;
      EXPECT_EQ(in->spec().get_string_attribute("espalier:seed"), "5") << name;
      EXPECT_NE(in->spec().get_string_attribute("espalier:inputs").find(" rules vine.yaml"),
                std::string::npos)
          << name;
    }
  }
  const auto one = files(root + "a"), other = files(root + "b");
  ASSERT_EQ(one.size(), other.size());
  for (const auto& [name, bytes] : one) {
    if (name != "report.json") {
      EXPECT_TRUE(other.at(name) == bytes) << name;
    }
    if (name.ends_with(".json") || name.ends_with(".state")) continue;
    EXPECT_EQ(bytes.find(root), std::string::npos) << name;
  }
  json a = report("a"), b = report("b");
  a.erase("run");
  b.erase("run");
  EXPECT_EQ(a, b);
  EXPECT_EQ(a.dump().find(root), std::string::npos);
}

TEST_F(Plot, PicturesDoNotChangeWhatGrows) {
  ASSERT_EQ(grow("", "with").status, 0);
  ASSERT_EQ(grow("--no-pictures", "without").status, 0);
  EXPECT_EQ(report("with")["growth"]["state_hash"], report("without")["growth"]["state_hash"]);
  ASSERT_EQ(grow("--no-pictures --iterations 13", "shorter").status, 0);
  EXPECT_NE(report("with")["growth"]["state_hash"], report("shorter")["growth"]["state_hash"]);
  EXPECT_FALSE(fs::exists(scratch_.path("without") / "vines.png"));
  EXPECT_TRUE(fs::exists(scratch_.path("without") / "plant.glb"));
}

TEST_F(Plot, CoarserModelsAreWrittenWhereAskedFor) {
  ASSERT_EQ(grow("--no-pictures --lods 3", "all").status, 0);
  std::uintmax_t before = fs::file_size(scratch_.path("all") / "plant.glb");
  for (const char* name : {"plant_lod1.glb", "plant_lod2.glb", "plant_lod3.glb"}) {
    EXPECT_LT(fs::file_size(scratch_.path("all") / name), before) << name;
    before = fs::file_size(scratch_.path("all") / name);
  }
  for (const json& plant : report("all")["growth"]["plants"])
    EXPECT_TRUE(plant["meeting_limbs"].is_number()) << plant;
  EXPECT_EQ(report("all")["world"]["scene_triangles"], 4) << "two quadrilaterals";
  for (const json& plant : report("all")["growth"]["plants"]) {
    EXPECT_GE(plant["triangles"].get<int>(), 6 * plant["segments"].get<int>() + plant["elements"].get<int>())
        << plant;
  }
  ASSERT_EQ(grow("--no-pictures", "one").status, 0);
  EXPECT_FALSE(fs::exists(scratch_.path("one") / "plant_lod1.glb"));
  EXPECT_EQ(tests::fileText(scratch_.path("one") / "plant.glb"),
            tests::fileText(scratch_.path("all") / "plant.glb"));
  EXPECT_EQ(grow("--no-pictures --lods 4", "four").status, 2);
}

/// Assimp reads both back.
TEST_F(Plot, TheObjModelHasTheTrianglesOfTheGlbModel) {
  ASSERT_EQ(grow("--no-pictures --obj", "both").status, 0);
  const auto trianglesIn = [&](const char* file) {
    const sim::Mesh mesh = scenes::importMesh(scratch_.path("both") / file, scenes::RegionsFrom::group);
    return mesh.triangles.size() + mesh.degenerate_dropped;
  };
  EXPECT_GT(trianglesIn("plant.glb"), 100u);
  EXPECT_EQ(trianglesIn("plant.obj"), trianglesIn("plant.glb"));
  EXPECT_TRUE(fs::exists(scratch_.path("both") / "plant.mtl"));
  ASSERT_EQ(grow("--no-pictures", "one").status, 0);
  EXPECT_FALSE(fs::exists(scratch_.path("one") / "plant.obj"));
  EXPECT_EQ(tests::fileText(scratch_.path("one") / "plant.glb"),
            tests::fileText(scratch_.path("both") / "plant.glb"));
}

TEST_F(Plot, InstancesMakeASmallerModel) {
  ASSERT_EQ(grow("--no-pictures --instances", "with").status, 0);
  ASSERT_EQ(grow("--no-pictures", "without").status, 0);
  EXPECT_LT(fs::file_size(scratch_.path("with") / "plant.glb"),
            fs::file_size(scratch_.path("without") / "plant.glb"));
}

TEST_F(Plot, TheSeedOfTheCommandLineWins) {
  ASSERT_EQ(grow("--no-pictures", "a").status, 0);
  ASSERT_EQ(grow("--no-pictures --seed 6", "b").status, 0);
  ASSERT_EQ(grow("--no-pictures --seed 5", "c").status, 0);
  EXPECT_NE(report("a")["growth"]["state_hash"], report("b")["growth"]["state_hash"]);
  EXPECT_EQ(report("a")["growth"]["state_hash"], report("c")["growth"]["state_hash"]);
}

TEST_F(Plot, ASeedBeyondTheScenesRangeIsAnError) {
  EXPECT_EQ(grow("--no-pictures --seed 9007199254740991", "a").status, 0);
  for (const char* seed : {"-1", "9007199254740992", "99999999999999999999", "1.5", "x"})
    EXPECT_EQ(grow("--no-pictures --seed " + std::string(seed), "b").status, 2) << seed;
  EXPECT_FALSE(fs::exists(scratch_.path("b")));
}

TEST_F(Plot, JsonPrintsTheReportAndNothingElse) {
  const auto ran = grow("--json --no-pictures");
  ASSERT_EQ(ran.status, 0);
  EXPECT_EQ(json::parse(ran.output), report());
}

TEST_F(Plot, QuietSaysNothing) {
  EXPECT_EQ(grow("--quiet --no-pictures").output, "");
}

}  // namespace
}  // namespace espalier
