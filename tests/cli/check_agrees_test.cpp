// espalier check names what grow and expose would, in the same words at the same places, before they begin.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "scenes/problem.h"
#include "tests/cli/plot.h"

namespace espalier {
namespace {

using Lines = std::vector<std::string>;
using nlohmann::json;

struct Edit {
  std::string from, to;
};

/// A scene that is wrong: how it differs from the plot, what is said, and where: lines of the scene, 0 for
/// the file as a whole.
struct Bad {
  std::string name;
  std::vector<Edit> edits;
  std::vector<std::pair<int, std::string>> said;
  std::string command = "grow";
};

const std::string kSeedLines = "seeds:\n      - [-0.4, 0.1, 0.1]\n      - [0.3, 0.1, 0.1]";
const std::string kEyeKey = "eye: [2.2, 1.6, 3.2]";
const std::string kVoxelKey = "voxel: 5 cm";
const std::string kBoundsKey = "bounds: {min: [-1.1, -0.1, -1.1], max: [1.1, 1.5, 1.1]}";
const std::string kRulesKey = "rules: vine.yaml";
const std::string kMeshLine = "  - file: plot.obj";
const std::string kPlantLines = "plants:\n  - name: vine\n    rules: vine.yaml\n    " + kSeedLines;

/// The plot with attractors, and a plant that grows to them.
std::vector<Edit> colony(const std::string& attractors, const std::string& lengths = "") {
  return {{kRulesKey, "rules: {propagate: colonization, colonization: {attractors: all" + lengths + "}}"},
          {"seed: 5", "seed: 5\nattractors: {all: {" + attractors + "}}"}};
}

/// The plot with a field.
std::vector<Edit> bent(const std::string& field) {
  return {{"seed: 5", "seed: 5\nfields: {bend: {" + field + "}}"}};
}

std::vector<Edit> crowned(const std::string& crown) {
  return {{kRulesKey, "rules: {propagate: colonization, colonization: {crown: {" + crown + "}}}"}};
}

std::vector<Bad> badScenes() {
  return {
      {"an unknown key", {{"seed: 5", "sede: 5"}}, {{15, "unknown key 'sede'"}}},
      {"a region that is not there",
       {{kSeedLines, "scatter: {region: groud, count: 3}"}},
       {{11, "no mesh of the scene has a region 'groud'"}}},
      {"a region with too little room",
       {{kSeedLines, "scatter: {region: ground, count: 90000}"}},
       {{11, "places that look up; expected at least 90000"}}},
      {"seeds in a wall",
       {{"[-0.4, 0.1, 0.1]", "[-0.4, 0.5, 0]"}, {"[0.3, 0.1, 0.1]", "[0.3, 0.5, 0]"}},
       {{12, "lies inside 'plot' (wall)"}, {13, "lies inside 'plot' (wall)"}}},
      {"a seed beyond the world", {{"[0.3, 0.1, 0.1]", "[90, 0, 0]"}}, {{13, "lies outside the world"}}},
      {"a seed beyond a world that fits its meshes",
       {{"[0.3, 0.1, 0.1]", "[90, 0, 0]"}, {kBoundsKey, "margin: 30 cm"}},
       {{13, "a seed of 'vine' at [90.000, 0.000, 0.000] lies outside the world"}}},
      {"a table of seeds beyond the world",
       {{kSeedLines, "points: far.csv"}},
       {{11,
         "a seed of 'vine' at [80.000, 1.000, 0.000] lies outside the world; 2 more of its seeds are as "
         "wrong"}}},
      {"two seeds of one key",
       {{"[-0.4, 0.1, 0.1]", "{at: [-0.4, 0.1, 0.1], key: a}"},
        {"[0.3, 0.1, 0.1]", "{at: [0.3, 0.1, 0.1], key: a}"}},
       {{13, "a second seed of this plant has the key"}}},
      {"a camera in a wall",
       {{kEyeKey, "eye: [0.1, 0.5, 0]"}},
       {{18, "camera 'main' stands inside 'plot' (wall)"}}},
      {"a camera in a wall, for light",
       {{kEyeKey, "eye: [0.1, 0.5, 0]"}, {kPlantLines, ""}},
       {{13, "camera 'main' stands inside 'plot' (wall)"}},
       "expose"},
      {"attractors in what stands there",
       colony("sphere: {radius: 1 mm}, at: [0, 0.475, 0.02], count: 30"),
       {{16, "0 lie beyond the world and 30 in what stands there"}}},
      {"attractors beyond the world",
       colony("sphere: {radius: 0.5}, at: [50, 0, 0], count: 30"),
       {{16, "30 lie beyond the world"}}},
      {"attractors in a sheet", colony("inside: plot, count: 30"), {{16, "attractors 'all': "}}},
      {"a crown out of reach",
       crowned("sphere: {radius: 0.5}, trunk: 30 m, count: 30"),
       {{10, "crown of vine"}}},
      {"one attractor", colony("points: one.csv"), {{10, "are one, or lie in one place"}}},
      {"a step that is too long",
       colony("sphere: {radius: 0.3}, at: [0, 0.8, 0.6], count: 30",
              ", step: 90 m, influence: 95 m, kill: 80 m"),
       {{10, "colonization.step is 1.8e+03 voxel widths"}}},
      {"a mesh that is not there", {{"plot.obj", "gone.obj"}}, {{4, "there is no mesh file"}}},
      {"a mesh that is none",
       {{"plot.obj", "bad.obj"}},
       {{4, "bad.obj: there are no triangles in the file"}}},
      {"two meshes that are none",
       {{kMeshLine, "  - file: bad.obj\n  - file: cut.glb"}},
       {{4, "bad.obj: there are no triangles in the file"}, {5, "cut.glb: "}}},
      {"a table that is none",
       {{kSeedLines, kSeedLines + "\n    points: bad.csv"}},
       {{14, "bad.csv: has no points"}}},
      {"a skeleton that is none", {{kSeedLines, "skeleton: bad.obj"}}, {{11, "bad.obj: there are no lines"}}},
      {"a skeleton beyond the world",
       {{kSeedLines, "skeleton: {file: sticks.obj, translate: [40, 0, 0]}"}},
       {{11, "outside of the world"}}},
      {"a field in a sheet", bent("angle: 90, within: plot"), {{16, "fields 'bend': "}}},
      {"a field of a volume that is none",
       bent("angle: 90, axis: grid, file: bad.vdb"),
       {{16, "fields 'bend': "}}},
      {"a texture that is none",
       {{kRulesKey, "rules: {elements: [{name: leaf, texture: bad.png}]}"}},
       {{10, "bad.png: "}}},
      {"more voxels than there may be",
       {{kVoxelKey, "voxel: 0.1 mm"}},
       {{6, "voxels of 0.0001 m make a world of "}}},
      {"more voxels than fit", {{kVoxelKey, "voxel: 0.15 mm"}}, {{6, "a world of "}}},
      {"a mesh in centimetres",
       {{"plot.obj", "house.obj"}, {kVoxelKey, "voxel: 1 cm"}, {kBoundsKey, "margin: 1"}},
       {{6, "a world of "}, {4, "as if its file counted another unit than metres"}}},
      {"rules that feel too far",
       {{kRulesKey, "rules: {require: {proximity: {max: 2 m}}}"}, {kVoxelKey, "voxel: 2 cm"}},
       {{10, "boundary layers; expected at most 64"}}},
      {"a world without a surface",
       {{kPlantLines, ""},
        {"min: [-1.1, -0.1, -1.1], max: [1.1, 1.5, 1.1]", "min: [3, 3, 3], max: [4, 4, 4]"}},
       {{6, "the world has no surface that can be lit"}},
       "expose"},
      {"more than one thing",
       {{"[-0.4, 0.1, 0.1]", "[-0.4, 0.5, 0]"},
        {kEyeKey, "eye: [0.1, 0.5, 0]"},
        {"seed: 5", "seed: 5\nattractors: {all: {sphere: {radius: 0.5}, at: [50, 0, 0], count: 30}}"}},
       {{12, "lies inside 'plot' (wall)"},
        {19, "camera 'main' stands inside"},
        {16, "30 lie beyond the world"}}},
  };
}

class Agreement : public tests::Plot {
 protected:
  void SetUp() override {
    Plot::SetUp();
    scratch_.write("bad.obj", "nothing\n");
    scratch_.write("cut.glb", "glTF");
    scratch_.write("bad.csv", "nothing\n");
    scratch_.write("bad.vdb", "nothing\n");
    scratch_.write("bad.png", "nothing\n");
    scratch_.write("cut.png", "\x89PNG\r\n\x1a\nnothing");
    scratch_.write("far.csv", "80, 1, 0\n0.3, 0.2, 0.1\n90, 1, 0\n0, 70, 0\n");
    scratch_.write("one.csv", "0, 0.8, 0.5\n");
    scratch_.write("sticks.obj", "v 0 0.2 0.3\nv 0 0.8 0.3\nl 1 2\n");
    std::string house;
    for (int corner = 0; corner < 8; ++corner)
      house += fmt::format("v {} {} {}\n", (corner & 1) * 880, (corner & 2) * 305, (corner & 4) * 145);
    scratch_.write("house.obj", house + "f 1 2 6 5\nf 1 3 4 2\nf 5 6 8 7\nf 1 5 7 3\nf 2 4 8 6\n");
  }

  std::string scene(const std::vector<Edit>& edits) {
    std::string text = tests::kPlotScene;
    for (const auto& [from, to] : edits) {
      const auto at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      if (at != std::string::npos) text.replace(at, from.size(), to);
    }
    return scratch_.write("scene.yaml", text).string();
  }
  static Lines linesOf(const std::string& output) {
    Lines lines;
    std::istringstream in(output);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  static bool isWarning(const std::string& line) { return line.find(": warning: ") != line.npos; }
  static Lines warningsIn(const std::string& output) {
    Lines lines = linesOf(output);
    std::erase_if(lines, [](const std::string& line) { return !isWarning(line); });
    return lines;
  }
  /// Which voxels would fit follows from the memory that is free at that moment.
  static std::string withoutWhatFits(const std::string& line) {
    static const std::regex fits("a voxel size of [0-9.]+ m would fit");
    return std::regex_replace(line, fits, "a voxel size would fit");
  }
  /// What a run says of files of the scene's, but warnings.
  Lines errorsIn(const std::string& output) const {
    Lines lines = linesOf(output);
    std::erase_if(lines, [&](const std::string& line) {
      return isWarning(line) || !line.starts_with(scratch_.path("").string());
    });
    for (std::string& line : lines) line = withoutWhatFits(line);
    return lines;
  }
  static std::string asLine(const json& problem) {
    const scenes::Problem read{problem["file"], problem.value("line", 0), problem.value("column", 0),
                               problem["message"]};
    return problem["severity"] == "warning" ? scenes::formatWarning(read) : scenes::format(read);
  }
};

TEST_F(Agreement, CheckSaysWhatGrowAndExposeSay) {
  for (const Bad& bad : badScenes()) {
    SCOPED_TRACE(bad.name);
    const std::string file = scene(bad.edits);
    const auto checked = tests::espalier("check " + file);
    EXPECT_EQ(checked.status, 2) << checked.output;
    const Lines lines = errorsIn(checked.output);
    EXPECT_EQ(lines.size(), bad.said.size()) << checked.output;
    for (std::size_t i = 0; i < std::min(lines.size(), bad.said.size()); ++i) {
      const auto& [line, text] = bad.said[i];
      EXPECT_TRUE(lines[i].starts_with(fmt::format("{}:{}:", file, line))) << lines[i];
      EXPECT_NE(lines[i].find(text), std::string::npos) << lines[i];
    }
    const auto ran = tests::espalier(bad.command + " " + file + " -o " + scratch_.path("out").string());
    EXPECT_EQ(ran.status, 2);
    EXPECT_EQ(lines, errorsIn(ran.output)) << ran.output;
    EXPECT_EQ(warningsIn(checked.output), warningsIn(ran.output));
    EXPECT_FALSE(std::filesystem::exists(scratch_.path("out/report.json")));

    const auto as_json = tests::espalier("check --json " + file);
    EXPECT_EQ(as_json.status, 2);
    Lines in_json;
    const json told = json::parse(as_json.output);
    for (const json& problem : told["problems"]) {
      if (problem["severity"] == "error") in_json.push_back(withoutWhatFits(asLine(problem)));
    }
    EXPECT_EQ(in_json, lines);
  }
}

TEST_F(Agreement, CheckWarnsAsGrowDoes) {
  scratch_.write("vine.yaml", tests::fileText(scratch_.path("vine.yaml")) + "\nregions: {nowhere: forbid}\n");
  scratch_.write("plot.mtl", "newmtl a\nKd 1 1 1\nmap_Kd gone.png\nnewmtl b\nKd 1 1 1\nmap_Kd cut.png\n");
  std::string mesh = std::string("mtllib plot.mtl\nvt 0 0\n") + tests::kPlotMesh;
  const auto replace = [&](const std::string& from, const std::string& to) {
    mesh.replace(mesh.find(from), from.size(), to);
  };
  replace("f 1 4 3 2", "usemtl a\nf 1/1 4/1 3/1 2/1");
  replace("f 5 6 7 8", "usemtl b\nf 5/1 6/1 7/1 8/1");
  scratch_.write("plot.obj", mesh);
  const std::string file = scene({});
  const auto checked = tests::espalier("check " + file);
  EXPECT_EQ(checked.status, 0) << checked.output;
  const Lines warnings = warningsIn(checked.output);
  EXPECT_EQ(warnings.size(), 3u) << checked.output;
  EXPECT_EQ(warnings, warningsIn(grow().output));
  Lines in_json;
  const json all = json::parse(tests::espalier("check --json " + file).output);
  for (const json& problem : all["problems"]) in_json.push_back(asLine(problem));
  EXPECT_EQ(in_json, warnings);
  EXPECT_EQ(all["foretold"][0]["size"], (json{44, 32, 44}));
  EXPECT_GT(all["foretold"][0]["seconds"], 0.0);
}

TEST_F(Agreement, ASceneWithoutItsOptionalMeshIsSkipped) {
  const std::string file = scene({{"plot.obj", "gone.obj\n    optional: true"}});
  const auto checked = tests::espalier("check " + file);
  EXPECT_EQ(checked.status, 0);
  EXPECT_TRUE(checked.output.starts_with(file + ":4:5: warning: the mesh ")) << checked.output;
  EXPECT_TRUE(checked.output.ends_with("gone.obj is not there; skipped, as the scene calls it optional\n"));
  EXPECT_EQ(grow().output, checked.output);
  const json said = json::parse(tests::espalier("check --json " + file).output);
  EXPECT_EQ(said["problems"][0]["severity"], "warning");
  EXPECT_TRUE(said["foretold"].empty());
}

/// Plants and an exposure: either may be meant.
TEST_F(Agreement, AnExposureThatDoesNotFitIsNamedBesideThePlants) {
  const std::string file = scene({{"seed: 5", "seed: 5\nexposure: {where: surfaces}"},
                                  {"plot.obj", "plot.obj\n    translate: [9, 9, 9]"}});
  const auto checked = tests::espalier("check " + file);
  EXPECT_EQ(checked.status, 2) << checked.output;
  EXPECT_EQ(checked.output,
            tests::espalier("expose " + file + " -o " + scratch_.path("out").string()).output);
}

}  // namespace
}  // namespace espalier
