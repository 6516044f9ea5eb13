#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "tests/bench/rows.h"

namespace espalier::bench {
namespace {

constexpr const char* kHeightsRow = "14 land by attractors";

/// The library's figure_16 with so many attractors, and one land of so many samples along its longer side.
void benchLand(int attractors, double samples, Report& report) {
  namespace fs = std::filesystem;
  auto scene = scenes::readScene(ESPALIER_SOURCE_DIR "/scenes/library/figure_16.yaml");
  if (!scene) throw sim::InputError(scenes::format(scene.problems()));
  for (scenes::AttractorsSpec& spec : scene->attractors) spec.strewing.count = attractors;
  scene->iterations = 100'000;
  scene->heights.erase(scene->heights.begin(), scene->heights.end() - 1);
  scene->heights[0].iteration.reset();
  scene->heights[0].spacing_m = 7900.0 / samples;
  scene->images.clear();
  scenes::RunOptions options;
  options.folder = fs::temp_directory_path() / fmt::format("espalier.bench.{}", ::getpid());
  const scenes::Report run = scenes::runScene(*scene, options, {.keep = false});
  fs::remove_all(options.folder);
  std::map<std::string, double> stages_s(run.run.stages_s.begin(), run.run.stages_s.end());
  report.note(fmt::format("  {} attractors, {:.0f} samples along x: {} segments, {:.2f} GB at most",
                          attractors, samples, run.growth->plants.at(0).segments,
                          static_cast<double>(run.run.peak_memory_bytes) / 1e9));
  const auto add = [&](const char* what, double seconds) { report.add({kHeightsRow, what, seconds, "s"}); };
  add("    growth", stages_s["growing"]);
  add("    the land, its mesh and colours", stages_s["making"]);
  add("    files", stages_s["writing"]);
  add("    all of it", run.run.total_s);
}

}  // namespace

void benchHeights(Report& report) {
  report.title("14. Land of a tree by its attractors, without pictures");
  for (const int attractors : {1000, 10'000, 100'000, 1'000'000}) benchLand(attractors, 1000.0, report);
}

}  // namespace espalier::bench
