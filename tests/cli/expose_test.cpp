// espalier expose as a user runs it: what it writes, what it says, and how it ends.
#include <OpenImageIO/imagebuf.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/process.h"
#include "tests/support/scratch.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A floor, and over half of it a roof on nothing: an overhang.
constexpr const char* kMesh = R"(
v 0 0 0
v 4 0 0
v 4 0 4
v 0 0 4
v 0 2 0
v 4 2 0
v 4 2 1.9
v 0 2 1.9
g floor
f 1 4 3 2
g roof
f 5 8 7 6
)";

constexpr const char* kScene = R"(espalier: scene
name: overhang
meshes:
  - file: overhang.obj
world:
  voxel: 25 cm
  bounds: {min: [0, -0.125, 0], max: [4, 3, 4]}
sky: {weighting: cosine, directions: 64}
image: {width: 120, height: 90}
)";

class Overhang : public testing::Test {
 protected:
  void SetUp() override {
    scratch_.write("overhang.obj", kMesh);
    scratch_.write("scene.yaml", kScene);
  }
  tests::Ran expose(const std::string& more = "", const std::string& folder = "out") {
    return tests::espalier("expose " + scratch_.path("scene.yaml").string() + " -o " +
                           scratch_.path(folder).string() + " " + more);
  }
  json read(const std::string& name, const std::string& folder = "out") {
    return json::parse(tests::fileText(scratch_.path(folder) / name));
  }
  static std::map<std::string, std::string> files(const fs::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(folder))
      all[entry.path().filename().string()] = tests::fileText(entry.path());
    return all;
  }

  tests::Scratch scratch_;
};

TEST_F(Overhang, WritesMapsFieldsTablesAndTheReport) {
  const auto ran = expose();
  ASSERT_EQ(ran.status, 0) << ran.output;
  std::set<std::string> names;
  for (const auto& [name, bytes] : files(scratch_.path("out"))) {
    names.insert(name);
    EXPECT_NE(ran.output.find(name), std::string::npos) << "the program does not name " << name;
  }
  for (const char* name : {"exposure.csv", "exposure.json", "exposure.vdb", "report.json", "sky_exposure.png",
                           "sky_exposure.exr", "sun_exposure.png", "sun_exposure.exr", "shadow_matte.png",
                           "surface_colour.png", "first_pass.png", "contact_sheet.png"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  EXPECT_FALSE(names.contains("threshold.png"));  // nothing grows here that could find it too dark
  const json report = read("report.json");
  EXPECT_EQ(report["files"].size(), names.size());
  EXPECT_FALSE(report.contains("growth"));
  EXPECT_EQ(report["light"]["weighting"], "cosine");
  EXPECT_EQ(report["exposure"]["surface_voxels"], read("exposure.json")["total"]["voxels"]);
}

TEST_F(Overhang, TheTableTellsTheOpenFromTheCovered) {
  const auto ran = expose("--no-pictures");
  ASSERT_EQ(ran.status, 0);
  const json table = read("exposure.json");
  ASSERT_EQ(table["regions"].size(), 2u);
  const json& floor = table["regions"][0];
  EXPECT_EQ(floor["region"], "floor");
  EXPECT_NEAR(floor["area_m2"].get<double>(), 16.0, 0.1);
  const double mean = floor["sky_exposure"]["mean"];
  EXPECT_GT(mean, 0.5);
  EXPECT_LT(mean, 0.9);
  EXPECT_EQ(table["regions"][1]["sky_exposure"]["mean"], 1.0);  // the roof sees all
  for (const char* word : {"floor", "roof", "all surfaces", "cosine", "directions", "standard error"})
    EXPECT_NE(ran.output.find(word), std::string::npos) << word << '\n' << ran.output;
}

TEST_F(Overhang, EveryByteIsTheSameOnOneTwoAndFiveThreads) {
  for (const int threads : {1, 2, 5}) {
    const auto ran = expose("--where band --threads " + std::to_string(threads), std::to_string(threads));
    ASSERT_EQ(ran.status, 0) << ran.output;
  }
  auto one = files(scratch_.path("1"));
  EXPECT_GT(one.size(), 12u);
  for (const char* folder : {"2", "5"}) {
    for (const auto& [name, bytes] : files(scratch_.path(folder))) {
      if (name == "report.json") continue;
      EXPECT_TRUE(one[name] == bytes) << folder << '/' << name;
    }
  }
  scratch_.write("scene.yaml", std::string(kScene) + "sun: {tilt: 21}\n");  // a little more, and it is told
  ASSERT_EQ(expose("--where band", "other").status, 0);
  const auto other = files(scratch_.path("other"));
  for (const char* name : {"exposure.csv", "exposure.json", "exposure.vdb"})
    EXPECT_FALSE(one.at(name) == other.at(name)) << name;
}

TEST_F(Overhang, WhereIsToldByTheSceneAndTheCommandLineWins) {
  const auto freeVoxels = [&](const std::string& more) {
    EXPECT_EQ(expose("--no-pictures " + more).status, 0);
    return read("report.json")["exposure"]["free_voxels"].get<int>();
  };
  EXPECT_EQ(freeVoxels(""), 0);
  scratch_.write("scene.yaml", std::string(kScene) + "exposure: {where: band, band: 1}\n");
  const int narrow = freeVoxels("");
  EXPECT_GT(narrow, 16 * 16 + 16 * 8);  // on the floor, on the roof, and below it
  const int wide = freeVoxels("--band 3");
  EXPECT_GT(wide, 2 * narrow);
  EXPECT_EQ(freeVoxels("--where surfaces"), 0);
  const int all = freeVoxels("--where everything");
  const json size = read("report.json")["world"]["size"];
  const int total = size[0].get<int>() * size[1].get<int>() * size[2].get<int>();
  const int standing = read("report.json")["world"]["occupied_voxels"];
  EXPECT_GT(all, wide);
  EXPECT_LE(all, total - standing);
  EXPECT_GE(all, total - 2 * standing);  // sheets may take light in a voxel beside their own
}

TEST_F(Overhang, EveryPictureAndTableNamesTheWeighting) {
  ASSERT_EQ(expose().status, 0);
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(scratch_.path("out"))) {
    const auto ending = entry.path().extension();
    if (ending == ".png" || ending == ".exr") {
      const OIIO::ImageBuf picture(entry.path().string());
      EXPECT_EQ(picture.spec()["espalier:weighting"].get(), "cosine") << entry.path();
      EXPECT_NE(picture.spec()["espalier:sky"].get().find("directions"), std::string::npos) << entry.path();
      ++pictures;
    } else {
      EXPECT_NE(tests::fileText(entry.path()).find("cosine"), std::string::npos) << entry.path();
    }
  }
  EXPECT_GT(pictures, 9);
}

TEST_F(Overhang, EachCameraHasItsPictures) {
  scratch_.write("scene.yaml", std::string(kScene) +
                                   "cameras:\n  near: {eye: [6, 3, 6], target: [2, 0, 2]}\n"
                                   "  above: {eye: [2, 12, 2], target: [2, 0, 2]}\n");
  ASSERT_EQ(expose().status, 0);
  for (const char* name : {"sky_exposure_near.png", "sky_exposure_above.exr", "contact_sheet_near.png"})
    EXPECT_TRUE(fs::exists(scratch_.path("out") / name)) << name;
}

/// Light falls whether or not anything can grow in it.
TEST_F(Overhang, PlantsThatCannotGrowAreNoHindrance) {
  scratch_.write("giant.yaml", "espalier: rules\nrandom_tree: {length: 40 m}\n");
  scratch_.write("vine.yaml", "espalier: rules\nregions: {bark: forbid}\n");
  scratch_.write("scene.yaml", std::string(kScene) +
                                   "plants:\n  - {name: giant, rules: giant.yaml, seeds: [[2, 1, 2]]}\n"
                                   "  - {name: buried, rules: vine.yaml, seeds: [[2, 0, 2]]}\n");
  const auto ran = expose();
  EXPECT_EQ(ran.status, 0) << ran.output;
  EXPECT_TRUE(fs::exists(scratch_.path("out/threshold.png")));
  const auto certified = tests::espalier("certify " + scratch_.path("scene.yaml").string());
  EXPECT_EQ(certified.status, 0) << certified.output;
}

TEST_F(Overhang, ACameraInAWallIsAnError) {
  scratch_.write("scene.yaml",
                 std::string(kScene) + "cameras:\n  low: {eye: [2, 0, 2], target: [2, 2, 2]}\n");
  const auto ran = expose();
  EXPECT_EQ(ran.status, 2) << ran.output;
  EXPECT_NE(ran.output.find("scene.yaml:11:9: camera 'low' stands inside 'overhang' (floor)"),
            std::string::npos)
      << ran.output;
}

TEST_F(Overhang, JsonPrintsTheReportAndQuietNothing) {
  const auto ran = expose("--json --no-pictures");
  ASSERT_EQ(ran.status, 0);
  EXPECT_EQ(json::parse(ran.output), read("report.json"));
  EXPECT_EQ(expose("--quiet --no-pictures").output, "");
}

TEST_F(Overhang, WrongSettingsAreNamedAndNothingIsWritten) {
  const auto fails = [&](const std::string& more, const std::string& says) {
    const auto ran = expose(more);
    EXPECT_EQ(ran.status, 2) << ran.output;
    EXPECT_NE(ran.output.find(says), std::string::npos) << ran.output;
    EXPECT_FALSE(fs::exists(scratch_.path("out")));
  };
  fails("--where walls", "surfaces");
  fails("--band 0", "--band");
  fails("--where everything --band 3", "expected --where band");
  scratch_.write("scene.yaml", std::string(kScene) + "exposure: {where: bands}\n");
  fails("", "did you mean 'band'");
  scratch_.write("scene.yaml", std::string(kScene) + "exposure: {band: 0}\n");
  fails("", "scene.yaml:10:");
  scratch_.write("scene.yaml",
                 "espalier: scene\nworld: {voxel: 1 m, bounds: {min: [0, 0, 0], max: [4, 4, 4]}}\n");
  fails("", "no surface");
}

TEST_F(Overhang, AnEmptyWorldIsOpenEverywhere) {
  scratch_.write("scene.yaml",
                 "espalier: scene\nworld: {voxel: 1 m, bounds: {min: [0, 0, 0], max: [4, 4, 4]}}\n"
                 "exposure: {where: everything}\n");
  const auto ran = expose();
  ASSERT_EQ(ran.status, 0) << ran.output;
  EXPECT_EQ(read("report.json")["exposure"]["free_voxels"], 64);
}

}  // namespace
}  // namespace espalier
