#include "tests/bench/wall_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace espalier::bench {

void writeWallScene(const std::filesystem::path& file, double segments) {
  constexpr double kPlantsToASquareMetre = 0.15;
  const double height_m = std::sqrt(segments / 1000.0 / 2.0), width_m = 2.0 * height_m;
  std::ofstream mesh(file.parent_path() / "wall.obj");
  mesh << "g wall\n";
  for (const double y : {0.0, height_m}) {
    for (const double z : {0.0, 0.2}) {
      for (const double x : {0.0, width_m}) mesh << fmt::format("v {} {} {}\n", x, y, z);
    }
  }
  mesh << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  const int rows = std::max(1, static_cast<int>(std::lround(height_m * std::sqrt(kPlantsToASquareMetre))));
  std::string seeds;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < 2 * rows; ++x) {
      seeds += fmt::format("{}{{at: [{}, {}, 0.25]}}", seeds.empty() ? "" : ", ",
                           width_m * (x + 0.5) / (2 * rows), 0.05 + height_m * y / rows);
    }
  }
  std::ofstream(file) << fmt::format(
      "espalier: scene\nmeshes: [{{file: wall.obj, name: wall, solid: true}}]\n"
      "world: {{voxel: 2 cm, bounds: {{min: [0, 0, -0.1], max: [{}, {}, 0.7]}}, layers: 4}}\n"
      "plants: [{{name: vine, rules: {}/rules/library/courtyard_vine.yaml, seeds: [{}]}}]\n"
      "iterations: 60\n",
      width_m, height_m, ESPALIER_SOURCE_DIR, seeds);
}

}  // namespace espalier::bench
