// What somebody meets who begins: a mesh of unknown origin, a first project, the library by name, keys
// explained.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/process.h"
#include "tests/support/scratch.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

class Strangers : public testing::Test {
 protected:
  std::string at(const std::string& name) const { return scratch_.path(name).string(); }
  static tests::Ran done(const std::string& arguments) {
    const tests::Ran ran = tests::espalier(arguments);
    EXPECT_EQ(ran.status, 0) << arguments << "\n" << ran.output;
    return ran;
  }
  static tests::Ran refused(const std::string& arguments) {
    const tests::Ran ran = tests::espalier(arguments);
    EXPECT_EQ(ran.status, 2) << arguments << "\n" << ran.output;
    return ran;
  }

  /// That grew in a run into this folder.
  int segments(const std::string& folder) const {
    int all = 0;
    const nlohmann::json grown = report(folder)["growth"];
    for (const auto& plant : grown["plants"]) all += plant["segments"].get<int>();
    return all;
  }
  nlohmann::json report(const std::string& folder) const {
    return nlohmann::json::parse(tests::fileText(scratch_.path(folder) / "report.json"));
  }

  tests::Scratch scratch_;
};

/// Centimetres, z up, faces inwards, no floor.
constexpr const char* kHouse =
    "g walls\nv -300 -200 0\nv 300 -200 0\nv 300 200 0\nv -300 200 0\nv -300 -200 280\nv 300 -200 280\nv 300 "
    "200 280\n"
    "v -300 200 280\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\ng roof\nf 5 8 7 6\n";

TEST_F(Strangers, MeshIsToldOfAndItsSceneWorksAtOnce) {
  scratch_.write("house.obj", kHouse);
  const std::string told = done("inspect " + at("house.obj") + " --scene " + at("scene.yaml")).output;
  for (const char* const part :
       {"size: 6 x 2.8 x 4 m", "unit: cm", "up: z", "4 open edges in 1 rim", "inside out", "'roof'"})
    EXPECT_NE(told.find(part), std::string::npos) << part << " is not in\n" << told;
  done("check " + at("scene.yaml"));
  done("expose " + at("scene.yaml") + " --quiet --no-pictures -o " + at("light"));
  done("grow " + at("scene.yaml") + " --quiet --no-pictures -o " + at("grown"));
  EXPECT_GT(segments("grown"), 30);
}

TEST_F(Strangers, SceneIsWrittenOverNothing) {
  scratch_.write("house.obj", kHouse);
  scratch_.write("mine.yaml", "espalier: scene\n");
  EXPECT_NE(refused("inspect " + at("house.obj") + " --scene " + at("mine.yaml")).output.find("--force"),
            std::string::npos);
  EXPECT_EQ(tests::fileText(scratch_.path("mine.yaml")), "espalier: scene\n");
  refused("inspect " + at("house.obj") + " --force --scene " + at("house.obj"));
  EXPECT_EQ(tests::fileText(scratch_.path("house.obj")), kHouse);
}

TEST_F(Strangers, FileThatIsNoMeshIsAnErrorAndNoSceneIsMade) {
  scratch_.write("bad.obj", "v 0 0\nf 1 2 3\n");
  refused("inspect " + at("bad.obj") + " --scene " + at("scene.yaml"));
  EXPECT_FALSE(fs::exists(at("scene.yaml")));
  refused("inspect " + at("none.obj"));
}

TEST_F(Strangers, FirstProjectIsCheckedAndGrows) {
  done("init " + at("garden"));
  EXPECT_EQ(done("check " + at("garden/ivy_here.yaml")).output, "");
  done("check " + at("garden/scene.yaml"));
  done("grow " + at("garden/scene.yaml") + " --quiet --no-pictures -o " + at("out"));
  EXPECT_GT(segments("out"), 200);
  EXPECT_TRUE(report("out")["warnings"].empty());
  for (const char* const file : {"scene.yaml", "ivy_here.yaml"}) {
    const std::string text = tests::fileText(scratch_.path("garden") / file);
    const std::string schema =
        text.substr(text.find("$schema=") + 8, text.find('\n') - text.find("$schema=") - 8);
    EXPECT_TRUE(nlohmann::json::accept(tests::fileText(scratch_.path("garden") / schema))) << schema;
  }
  const auto settings = nlohmann::json::parse(tests::fileText(scratch_.path("garden/.vscode/settings.json")));
  for (const auto& [schema, files] : settings["yaml.schemas"].items())
    EXPECT_TRUE(fs::exists(scratch_.path("garden") / schema)) << schema;
}

TEST_F(Strangers, FirstProjectIsMadeInNoFolderThatHoldsAnything) {
  scratch_.write("full/notes.txt", "mine");
  EXPECT_NE(refused("init " + at("full")).output.find("not empty"), std::string::npos);
  EXPECT_FALSE(fs::exists(at("full/scene.yaml")));
  refused("init " + at("full/notes.txt"));
  fs::create_directories(at("empty"));
  done("init " + at("empty"));
}

TEST_F(Strangers, KeysAreExplainedByPathLastWordAndGreenesName) {
  const std::string up = done("explain bias.up").output;
  for (const char* const part :
       {"bias.up, in rule files", "value: ", "range: ", "default: ", "  bias:\n    up: ...\n"})
    EXPECT_NE(up.find(part), std::string::npos) << part << " is not in\n" << up;
  EXPECT_NE(done("explain voxel").output.find("world.voxel, in scene files"), std::string::npos);
  EXPECT_NE(done("explain seekprox").output.find("prefer.proximity"), std::string::npos);
  EXPECT_EQ(done("explain 'elements[].size'").output, done("explain elements.size").output);
  EXPECT_NE(done("explain elements.size").output.find("  elements:\n    - size: ...\n"), std::string::npos);
  EXPECT_NE(refused("explain voxle").output.find("did you mean 'voxel'?"), std::string::npos);
}

TEST_F(Strangers, CommandsAndRuleSetsHaveNearNames) {
  EXPECT_NE(refused("inspekt a.obj").output.find("did you mean 'inspect'?"), std::string::npos);
  EXPECT_NE(refused("rules ivi").output.find("did you mean 'ivy'?"), std::string::npos);
  EXPECT_NE(refused("inspect a.obj --secne b.yaml").output.find("did you mean '--scene'?"),
            std::string::npos);
}

}  // namespace
}  // namespace espalier
