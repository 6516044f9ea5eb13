// The program as a user runs it: what it writes, what it says, and how it ends.
#include <gtest/gtest.h>

#include <OpenImageIO/imageio.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <tuple>

#include "scenes/read/read_scene.h"
#include "scenes/show/picture_memory.h"
#include "sim/base/hasher.h"
#include "sim/base/parallel.h"
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
       {"plant.glb", "world.vdb", "report.json", "vines.png", "sun_exposure.png", "sun_exposure.exr",
        "sky_exposure.png", "sky_exposure.exr", "threshold.png", "shadow_matte.png", "surface_colour.png",
        "first_pass.png", "section.png", "contact_sheet.png"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  const json r = report();
  EXPECT_GT(r["growth"]["buds"]["grown"].get<int>(), 30);
  EXPECT_EQ(r["growth"]["plants"].size(), 2u);
  EXPECT_EQ(r["world"]["size"], json({44, 32, 44}));
  EXPECT_EQ(r["files"].size(), names.size());
  EXPECT_GT(r["run"]["peak_memory_bytes"].get<double>(), 1e6);
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
  for (const char* name : {"plant.glb", "world.vdb", "growth.state", "vines.png", "sky_exposure.png", "sky_exposure.exr"})
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

TEST_F(Plot, PicturesThatTakeTooMuchMemoryAreRefusedBeforeAnythingIsTiled) {
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("width: 160, height: 120"), 23, "width: 16000, height: 16000");
  scratch_.write("scene.yaml", scene);
  scratch_.write("plot.obj", "f 1 2 3\n");  // tiling would begin with a complaint about it
  for (const char* command : {"grow", "expose"}) {
    const auto ran =
        tests::run("ulimit -v 8000000; " + std::string(ESPALIER_PROGRAM) + " " + command + " " +
                   scratch_.path("scene.yaml").string() + " -o " + scratch_.path("out").string());
    EXPECT_EQ(ran.status, 2);
    EXPECT_NE(ran.output.find("scene.yaml:16:1: "), std::string::npos) << ran.output;
    EXPECT_NE(ran.output.find("5.7 GB are free for it here; expected at most "), std::string::npos)
        << ran.output;
    EXPECT_EQ(ran.output.find("plot.obj"), std::string::npos) << ran.output;
    EXPECT_FALSE(fs::exists(scratch_.path("out")));
  }
}

TEST_F(Plot, PicturesTakeNoMoreMemoryThanIsCounted) {
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("width: 160, height: 120"), 23, "width: 1600, height: 1200");
  scratch_.write("scene.yaml", scene);
  ASSERT_EQ(grow("--threads 2", "with").status, 0);
  ASSERT_EQ(grow("--threads 2 --no-pictures", "without").status, 0);
  const auto peak = [&](const char* folder) {
    return report(folder)["run"]["peak_memory_bytes"].get<double>();
  };
  const auto read = scenes::readScene(scratch_.path("scene.yaml"));
  ASSERT_TRUE(read);
  double counted = 0.0;
  sim::onThreads(2, [&] { counted = scenes::pictureBytes(scenes::picturesOf(*read), 1.0); });
  EXPECT_LT(peak("with") - peak("without"), counted);
  EXPECT_GT(peak("with") - peak("without"), 0.25 * counted);
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

TEST_F(Plot, BadInputIsNamedWithItsPlaceAndNothingIsWritten) {
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("iterations: 14"), 14, "iteratons: 14");
  scene.replace(scene.find("voxel: 5 cm"), 11, "voxel: -5 cm");
  scratch_.write("scene.yaml", scene);
  const auto ran = grow();
  EXPECT_EQ(ran.status, 2);
  EXPECT_NE(ran.output.find("scene.yaml:6:"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("scene.yaml:14:1:"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("did you mean 'iterations'"), std::string::npos) << ran.output;
  EXPECT_FALSE(fs::exists(scratch_.path("out")));
}

TEST_F(Plot, WhatOnlyShowsInTheWorldIsNamedToo) {
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string scene = tests::kPlotScene;
    scene.replace(scene.find(from), from.size(), to);
    scratch_.write("scene.yaml", scene);
    const auto ran = grow();
    EXPECT_EQ(ran.status, 2) << to;
    EXPECT_NE(ran.output.find("scene.yaml"), std::string::npos) << ran.output;
    EXPECT_FALSE(fs::exists(scratch_.path("out")));
    return ran.output;
  };
  EXPECT_NE(with("[-0.4, 0.1, 0.1]", "[-0.4, 0.5, 0.0]").find("(wall)"), std::string::npos);
  EXPECT_NE(with("plot.obj", "missing.obj").find("missing.obj"), std::string::npos);
  const std::string large = with("voxel: 5 cm", "voxel: 0.02 mm");
  EXPECT_NE(large.find("voxel"), std::string::npos) << large;
}

TEST_F(Plot, ARegionThatTheSceneLacksIsAWarningAndWithStrictAnError) {
  scratch_.write("vine.yaml",
                 tests::fileText(scratch_.path("vine.yaml")) + "\nregions: {wal: forbid, wall: {}}\n");
  const auto warned = grow("--no-pictures");
  EXPECT_EQ(warned.status, 0) << warned.output;
  const auto at = warned.output.find(
      ": warning: no mesh of the scene has a region 'wal'; expected one of ground, "
      "wall; did you mean 'wall'?\n");
  ASSERT_NE(at, std::string::npos) << warned.output;
  EXPECT_LT(at, warned.output.find("growing")) << "told before anything grows";
  EXPECT_EQ(warned.output.find("warning", at + 10), std::string::npos) << "told once";
  const auto told = report()["warnings"];
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(told[0].get<std::string>().starts_with("vine.yaml:")) << told[0];
  const auto strict = grow("--no-pictures --strict", "strict");
  EXPECT_EQ(strict.status, 2);
  EXPECT_NE(strict.output.find(":11: no mesh of the scene has a region 'wal'"), std::string::npos)
      << strict.output;
  EXPECT_FALSE(fs::exists(scratch_.path("strict")));
  EXPECT_EQ(grow("--no-pictures --quiet", "quiet").output, "");
  EXPECT_EQ(report("quiet")["warnings"], told);
}

TEST_F(Plot, AStemThatHasNoEffectIsAWarningWithItsPlace) {
  const std::string vine = tests::fileText(scratch_.path("vine.yaml"));
  scratch_.write("vine.yaml",
                 vine + "\notherwise:\n  stem: {radius: 0.2}\nregions: {wall: {stem: {radius: 0.3}}}\n");
  const auto ran = grow("--no-pictures", "told");
  EXPECT_EQ(ran.status, 0);
  EXPECT_NE(ran.output.find(":3: warning: otherwise.stem has no effect"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("warning: regions.wall.stem has no effect"), std::string::npos) << ran.output;
  EXPECT_EQ(report("told")["warnings"].size(), 2u);
  EXPECT_EQ(grow("--no-pictures --strict", "strict").status, 2);
}

TEST_F(Plot, AWarningInTheReportIsTheSameHoweverTheFilesAreNamed) {
  scratch_.write("vine.yaml", tests::fileText(scratch_.path("vine.yaml")) + "\nregions: {wal: forbid}\n");
  const std::string folder = scratch_.path("").string();
  for (const std::string& rules :
       {std::string("vine.yaml"), folder + "vine.yaml",
        "../" + scratch_.path("").parent_path().filename().string() + "/vine.yaml"}) {
    std::string scene = tests::kPlotScene;
    scratch_.write("scene.yaml", scene.replace(scene.find("vine.yaml"), 9, rules));
    for (const std::string& started : {std::string("/"), folder}) {
      const std::string named = started == "/" ? folder + "scene.yaml" : "scene.yaml";
      const auto ran = tests::run("cd " + started + " && " + ESPALIER_PROGRAM + " grow " + named + " -o " +
                                  folder + "out --no-pictures --quiet");
      ASSERT_EQ(ran.status, 0) << ran.output;
      EXPECT_TRUE(report()["warnings"][0].get<std::string>().starts_with("vine.yaml:"))
          << report()["warnings"] << " of " << rules << " from " << started;
    }
  }
}

TEST_F(Plot, StrictMindsNothingWhereAllIsWell) {
  const auto ran = grow("--no-pictures --strict");
  EXPECT_EQ(ran.status, 0) << ran.output;
  EXPECT_EQ(report()["warnings"], json::array());
}

TEST_F(Plot, AFullDiskIsAnErrorAndLeavesNoHalfFiles) {
  ASSERT_EQ(grow("--no-pictures").status, 0);
  const auto before = files(scratch_.path("out"));
  const auto ran = tests::run("ulimit -f 20; " + std::string(ESPALIER_PROGRAM) + " grow " +
                              scratch_.path("scene.yaml").string() + " --seed 9 --no-pictures -o " +
                              scratch_.path("out").string());
  EXPECT_EQ(ran.status, 2) << ran.output;
  EXPECT_NE(ran.output.find("cannot write"), std::string::npos) << ran.output;
  const auto kept = tests::run(
      "ulimit -f 20; " + std::string(ESPALIER_PROGRAM) + " grow " + scratch_.path("scene.yaml").string() +
      " --seed 9 --no-pictures --quiet --save-every 1 -o " + scratch_.path("out").string());
  EXPECT_EQ(kept.status, 2);
  EXPECT_EQ(kept.output.find((scratch_.path("out") / "growth.state").string()), 0u) << kept.output;
  EXPECT_EQ(files(scratch_.path("out")).at("world.vdb"), before.at("world.vdb"));
  EXPECT_EQ(files(scratch_.path("out")).size(), before.size());
}

/// Starts the program, and sends it a signal after a while.
int growAndSignal(const std::string& scene, const std::string& folder, int signal, int after_ms) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl(ESPALIER_PROGRAM, ESPALIER_PROGRAM, "grow", scene.c_str(), "-o", folder.c_str(), "--quiet",
            nullptr);
    ::_exit(127);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
  ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST_F(Plot, KilledAtAnyMomentNoFileIsHalf) {
  ASSERT_EQ(grow("", "whole").status, 0);
  auto whole = files(scratch_.path("whole"));
  const auto out = scratch_.path("out");
  for (int after_ms = 40; after_ms < 1000; after_ms += 120) {
    growAndSignal(scratch_.path("scene.yaml"), out, SIGKILL, after_ms);
    if (!fs::exists(out)) continue;
    for (const auto& [name, bytes] : files(out)) {
      if (name.starts_with(".espalier-part-") || name == "report.json") continue;
      EXPECT_TRUE(bytes == whole[name]) << name << " after " << after_ms << " ms";
    }
  }
  ASSERT_EQ(grow().status, 0);
  for (const auto& [name, bytes] : files(out)) EXPECT_FALSE(name.starts_with(".espalier-part-")) << name;
}

TEST_F(Plot, CtrlCEndsCleanly) {
  std::string scene = tests::kPlotScene;
  scene.replace(scene.find("iterations: 14"), 14, "iterations: 100000");
  scene.replace(scene.find("voxel: 5 cm"), 11, "voxel: 1 cm");
  scratch_.write("scene.yaml", scene);
  EXPECT_EQ(growAndSignal(scratch_.path("scene.yaml"), scratch_.path("out"), SIGINT, 600), 130);
  EXPECT_FALSE(fs::exists(scratch_.path("out")));
}

TEST(CommandLine, HelpVersionAndMistakes) {
  EXPECT_EQ(tests::espalier("--help").status, 0);
  EXPECT_NE(tests::espalier("--help").output.find("grow"), std::string::npos);
  EXPECT_EQ(tests::espalier("--version").status, 0);
  EXPECT_EQ(tests::espalier("").status, 2);
  EXPECT_EQ(tests::espalier("grow").status, 2);
  EXPECT_EQ(tests::espalier("plant x").status, 2);
  EXPECT_EQ(tests::espalier("grow no-such-scene.yaml").status, 2);
}

TEST(CommandLine, CheckNamesEveryErrorOfEveryFile) {
  const tests::Scratch scratch;
  const auto a = scratch.write("a.yaml", "espalier: rules\nnam: x\nlight: {boost: -1}\n");
  const auto b = scratch.write("b.yaml", "espalier: scene\nmeshes: 3\n");
  const auto ran = tests::espalier("check " + a.string() + " " + b.string());
  EXPECT_EQ(ran.status, 2);
  for (const char* part : {"a.yaml:2:1:", "did you mean 'name'", "a.yaml:3:", "b.yaml:2:"}) {
    EXPECT_NE(ran.output.find(part), std::string::npos) << part << " in\n" << ran.output;
  }
}

TEST(CommandLine, SchemasAreJson) {
  for (const char* kind : {"rules", "scene"}) {
    const auto ran = tests::espalier(std::string("schema ") + kind);
    EXPECT_EQ(ran.status, 0);
    EXPECT_EQ(json::parse(ran.output)["$schema"], "https://json-schema.org/draft/2020-12/schema");
  }
  EXPECT_NE(tests::espalier("schema plants").status, 0);
}

}  // namespace
}  // namespace espalier
