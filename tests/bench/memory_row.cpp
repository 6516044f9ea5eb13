#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/base/error.h"
#include "tests/bench/rows.h"

namespace espalier::bench {
namespace {

namespace fs = std::filesystem;

/// What a run of the program held at most, and what it grew.
struct Ran {
  double peak_bytes = 0.0, segments = 0.0;
};

/// A wall twice as wide as it is high with half a metre of air before it, 1,000 segments to a square metre:
/// in 60 iterations each of figure 4's vines grows some 6,000.
void writeScene(const fs::path& file, double segments) {
  constexpr double kSeedsToASquareMetre = 0.15;
  const double height_m = std::sqrt(segments / 1000.0 / 2.0), width_m = 2.0 * height_m;
  std::ofstream mesh(file.parent_path() / "wall.obj");
  mesh << "g wall\n";
  for (const double y : {0.0, height_m}) {
    for (const double z : {0.0, 0.2}) {
      for (const double x : {0.0, width_m}) mesh << fmt::format("v {} {} {}\n", x, y, z);
    }
  }
  mesh << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  const int rows = std::max(1, static_cast<int>(std::lround(height_m * std::sqrt(kSeedsToASquareMetre))));
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

Ran run(const std::string& command, const fs::path& scene, const std::string& options) {
  const fs::path out = scene.parent_path() / "out";
  const std::string line = fmt::format("'{}' {} '{}' -o '{}' --quiet {}", ESPALIER_PROGRAM, command,
                                       scene.string(), out.string(), options);
  if (std::system(line.c_str()) != 0) throw sim::InputError(fmt::format("failed: {}", line));
  const auto report = nlohmann::json::parse(std::ifstream(out / "report.json"));
  Ran ran{report.at("run").at("peak_memory_bytes").get<double>(), 0.0};
  if (!report.contains("growth")) return ran;
  for (const auto& plant : report.at("growth").at("plants"))
    ran.segments += plant.at("segments").get<double>();
  return ran;
}

}  // namespace

void benchMemory(double most_segments, Report& report) {
  constexpr const char* kRow = "6 memory";
  report.title(
      "6. The most memory that espalier grow --no-pictures holds, whole, its files included: plain walls of "
      "2 cm "
      "voxels, figure 4's rules");
  const fs::path folder = fs::temp_directory_path() / fmt::format("espalier.bench.{}", ::getpid());
  fs::create_directories(folder);
  for (double segments = 1e4; segments <= most_segments; segments *= 10.0) {
    const fs::path scene = folder / "wall.yaml";
    writeScene(scene, segments);
    const Ran grown = run("grow", scene, "--no-pictures"),
              bare = run("grow", scene, "--no-pictures --iterations 0"), exposed = run("expose", scene, "");
    const auto aSegment = [&](double bytes) { return bytes / grown.segments; };
    report.note(fmt::format("{:.0f} segments: {:.0f} MB; expose {:.0f} MB", grown.segments,
                            grown.peak_bytes / 1e6, exposed.peak_bytes / 1e6));
    report.add({kRow, "  more than espalier expose, a segment",
                aSegment(grown.peak_bytes - exposed.peak_bytes), "bytes", 0, Target{2000.0, false}});
    report.add({kRow, "  more than without an iteration, a segment",
                aSegment(grown.peak_bytes - bare.peak_bytes), "bytes", 0});
  }
  fs::remove_all(folder);
}

}  // namespace espalier::bench
