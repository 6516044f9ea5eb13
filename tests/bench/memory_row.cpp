#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/base/error.h"
#include "tests/bench/rows.h"
#include "tests/bench/wall_scene.h"

namespace espalier::bench {
namespace {

namespace fs = std::filesystem;

/// What a run of the program held at most, and what it grew.
struct Ran {
  double peak_bytes = 0.0, segments = 0.0;
};

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
    writeWallScene(scene, segments);
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
