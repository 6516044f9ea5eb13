#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/image/image_io.h"
#include "scenes/job/expose.h"
#include "scenes/job/fed.h"
#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"
#include "scenes/read/read_table.h"
#include "scenes/read/registry.h"
#include "sim/base/error.h"
#include "tests/scenes/job/changed_scene.h"
#include "tests/scenes/job/scene_key_changes.h"
#include "tests/support/scratch.h"
#include "tests/support/volumes.h"

/// Every key of scene files changes something that comes out: a new one fails here until somebody says what
/// in scene_key_changes.h. (Those of rule files: tests/rules/growth/every_key_test.cpp.)
namespace espalier::scenes {
namespace {

std::string edited(std::string text, const Edit& edit) {
  const auto at = text.find(edit.from);
  EXPECT_NE(at, std::string::npos) << edit.from << " is not in\n" << text;
  return at == std::string::npos ? text : text.replace(at, edit.from.size(), edit.to);
}

class EverySceneKey : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    scratch_.write("plot.obj", tests::kChangedMesh);
    scratch_.write(
        "flat.obj",
        std::string(tests::kChangedMesh).substr(0, std::string(tests::kChangedMesh).find("g block")));
    std::string block(tests::kChangedMesh);
    block = block.substr(block.find("v 0.3"));
    for (int i = 0; i < 8; ++i) block = "v 0 0 0\n" + block;  // before those that it counts from
    scratch_.write("block.obj", block);
    const auto grid = [](const char* name, sim::Vec3 vector) {
      return tests::vectorGrid(name, 0.5, {-3, -1, -3}, {7, 5, 7}, [=](sim::Vec3) { return vector; });
    };
    tests::writeVolume(scratch_.path("winds.vdb"), {grid("a", {0, 1, 0})});
    tests::writeVolume(scratch_.path("other.vdb"), {grid("a", {1, 0, 0})});
    tests::writeVolume(scratch_.path("two.vdb"), {grid("a", {0, 1, 0}), grid("b", {1, 0, 0})});
    for (const bool east : {true, false}) {
      render::Image sky(16, 8, 1, 0.05f);
      for (int y = 1; y < 4; ++y) *sky.at(east ? 12 : 4, y) = 1.0f;
      scratch_.write(east ? "east.png" : "west.png", render::encodePng(sky));
    }
    scratch_.write("listed.csv", "0,0.5,0.4\n0.1,0.5,0.4\n");
    scratch_.write("typed.csv", "0,0.5,0.4,1\n0.1,0.5,0.4,2\n");
    scratch_.write("sticks.obj", "v 0 0.2 0.3\nv 0 0.7 0.3\nv 0.3 1 0.5\nl 1 2 3\n");
    scratch_.write("others.obj", "v 0 0.2 0.3\nv 0 0.8 0.3\nv 0.3 1 0.5\nl 1 2 3\n");
    scratch_.write("other.csv", "0,0.5,0.4\n0.1,0.6,0.4\n");
    scratch_.write(
        "made.yaml",
        "espalier: scene\nmeshes: [{file: block.obj}]\nworld: {voxel: 10 cm, margin: 60 cm}\n"
        "plants: [{rules: {random_tree: {trials: {min: 4, max: 20}}}, seeds: [[0.5, 0.75, 0.5]]}]\n"
        "iterations: 3\nimage: {width: 16, height: 16}\n"
        "cameras: {main: {eye: [2, 2, 3], target: [0.5, 0.5, 0.5]}}\nimages: [{kind: graph, name: drawn}]\n");
    scratch_.write("paint.mtl", "newmtl stone\nKd 0.5 0.5 0.5\nnewmtl brick\nKd 0.6 0.2 0.1\n");
    scratch_.write(
        "vine.yaml",
        "espalier: rules\nrandom_tree: {trials: {min: 4, max: 20}}\nrequire: {exposure: {min: 0.1}}\n"
        "elements: [{polygons: [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]}]\n");
  }

  /// All that a run of a scene writes, by file names; or under "error" why it writes nothing. What a file
  /// says of the files that it was made from, and a report of the run itself, are left out: they differ with
  /// every edit.
  std::map<std::string, std::string> filesOf(const std::string& text, bool expose) {
    auto scene = readScene(scratch_.write("scene.yaml", text));
    if (!scene) return {{"error", "error: " + format(scene.problems())}};
    scene->read_files.clear();
    const auto folder = scratch_.path("out");
    std::filesystem::remove_all(folder);
    RunOptions options;
    options.folder = folder;
    try {
      if (expose) {
        options.pictures = false;
        exposeScene(*scene, options);
      } else {
        runScene(*scene, options, {.keep = false});
      }
    } catch (const MeshMissing&) {
      return {{"error", "skipped"}};
    } catch (const sim::InputError& error) {
      return {{"error", std::string("error: ") + error.what()}};
    }
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file() && !entry.path().string().starts_with((folder / kFedFolder).string()))
        files[std::filesystem::relative(entry.path(), folder).string()] = tests::fileText(entry.path());
    }
    auto report = nlohmann::json::parse(files.at("report.json"));
    if (report.contains("growth")) files["state_hash"] = report["growth"]["state_hash"];
    report.erase("run");
    report.erase("inputs");
    files["report.json"] = report.dump(1);
    return files;
  }

  /// One output of a run of a scene, or why there is none.
  static std::string outputIn(const std::map<std::string, std::string>& files, const std::string& output) {
    if (const auto error = files.find("error"); error != files.end()) return error->second;
    if (output == "error") return "none";
    return files.at(output.starts_with(kExposed) ? output.substr(kExposed.size()) : output);
  }
  std::string outputOf(const std::string& text, const std::string& output) {
    return outputIn(filesOf(text, output.starts_with(kExposed)), output);
  }

  /// The same of a scene to which many keys are added in turn: run twice the first time that it is asked for,
  /// and the same both times.
  std::string outputOfBase(const std::string& text, const std::string& output) {
    static std::map<std::pair<std::string, bool>, std::map<std::string, std::string>> known;
    const bool expose = output.starts_with(kExposed);
    const auto [at, is_new] = known.try_emplace({text, expose});
    if (is_new) {
      at->second = filesOf(text, expose);
      EXPECT_EQ(at->second, filesOf(text, expose)) << "which changes by itself";
    }
    return outputIn(at->second, output);
  }

  static constexpr std::string_view kExposed = "expose: ";
  tests::Scratch scratch_;
};

TEST_P(EverySceneKey, ChangesWhatComesOut) {
  const auto at = changes().find(GetParam());
  ASSERT_NE(at, changes().end()) << GetParam() << " is new: say what it changes";
  const Change& change = at->second;
  std::string text = tests::kChangedScene;
  for (const Edit& edit : change.before) text = edited(text, edit);
  const std::string without = outputOfBase(text, change.output),
                    with = outputOf(edited(text, change.change), change.output);
  EXPECT_NE(without, with) << GetParam() << " changes nothing in " << change.output;
  if (change.output != "error") {
    EXPECT_FALSE(without.empty() || without.starts_with("error")) << without;
    EXPECT_FALSE(with.empty() || with.starts_with("error")) << with;
  }
}

std::vector<std::string> keys() {
  std::vector<std::string> paths;
  forEachKey(sceneTable(), [&](const std::string& path, const rules::Key& key) {
    if (!key.child) paths.push_back(path);
  });
  return paths;
}

TEST(SceneKeys, OfWhichSomethingIsKnownAreKeys) {
  const auto paths = keys();
  const std::set<std::string> known(paths.begin(), paths.end());
  for (const auto& [path, change] : changes()) EXPECT_TRUE(known.contains(path)) << path;
}

INSTANTIATE_TEST_SUITE_P(Scene, EverySceneKey, testing::ValuesIn(keys()), [](const auto& key) {
  std::string name = key.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

}  // namespace
}  // namespace espalier::scenes
