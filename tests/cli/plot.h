#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/process.h"
#include "tests/support/scratch.h"

/// A scene for the program to run: a wall on a floor, two vines, every kind of picture.
namespace espalier::tests {

inline constexpr const char* kPlotMesh = R"(
v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
v -1 0 0
v 1 0 0
v 1 1 0
v -1 1 0
g ground
f 1 4 3 2
g wall
f 5 6 7 8
)";

inline constexpr const char* kPlotScene = R"(espalier: scene
name: plot
meshes:
  - file: plot.obj
world:
  voxel: 5 cm
  bounds: {min: [-1.1, -0.1, -1.1], max: [1.1, 1.5, 1.1]}
plants:
  - name: vine
    rules: vine.yaml
    seeds:
      - [-0.4, 0.1, 0.1]
      - [0.3, 0.1, 0.1]
iterations: 14
seed: 5
image: {width: 160, height: 120}
cameras:
  main: {eye: [2.2, 1.6, 3.2], target: [0, 0.5, 0]}
images:
  - sun_exposure
  - sky_exposure
  - threshold
  - shadow_matte
  - surface_colour
  - first_pass
  - vines
  - {kind: section, axis: y, at: 0.5}
  - {kind: contact_sheet, of: [sun_exposure, sky_exposure, threshold, shadow_matte, surface_colour, first_pass]}
)";

/// A scene with its files in a folder of its own.
class Plot : public testing::Test {
 protected:
  void SetUp() override {
    scratch_.write("plot.obj", kPlotMesh);
    scratch_.write("vine.yaml", fileText(sourceFolder() / "rules/library/courtyard_vine.yaml"));
    scratch_.write("vine.yaml", withoutRegions(fileText(scratch_.path("vine.yaml"))));
    scratch_.write("scene.yaml", kPlotScene);
  }

  Ran grow(const std::string& more = "", const std::string& folder = "out") {
    return espalier("grow " + scratch_.path("scene.yaml").string() + " -o " + scratch_.path(folder).string() +
                    " " + more);
  }
  nlohmann::json report(const std::string& folder = "out") {
    return nlohmann::json::parse(fileText(scratch_.path(folder) / "report.json"));
  }
  static std::map<std::string, std::string> files(const std::filesystem::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      all[entry.path().filename().string()] = fileText(entry.path());
    }
    return all;
  }

  Scratch scratch_;

 private:
  /// The plot has other regions than the garden wall.
  static std::string withoutRegions(std::string text) {
    const auto at = text.find("\nregions:");
    if (at == std::string::npos) return text;
    const auto end = text.find("\n", text.find("\n", at + 1));
    auto next = end;
    while (next != std::string::npos && next + 1 < text.size() &&
           (text[next + 1] == ' ' || text[next + 1] == '#')) {
      next = text.find('\n', next + 1);
    }
    return text.substr(0, at) + (next == std::string::npos ? "\n" : text.substr(next));
  }
};

}  // namespace espalier::tests
