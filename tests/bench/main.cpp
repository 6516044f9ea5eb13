#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <exception>
#include <set>

#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "tests/bench/machine.h"
#include "tests/bench/rows.h"

namespace {

using namespace espalier;

scenes::Scene gardenWall() {
  auto scene = scenes::readScene(ESPALIER_SOURCE_DIR "/scenes/library/garden_wall.yaml");
  if (!scene) throw sim::InputError(scenes::format(scene.problems()));
  return std::move(*scene);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures exposure and growth against other ways to do it, in one run: medians of five.",
               "bench");
  std::string csv = "out/bench.csv", document;
  double most_voxels = 1.1e9, most_segments = 1e6;
  int most_attractors = 1'000'000;
  std::set<int> rows;
  app.add_option("--csv", csv, "Where the table goes")->capture_default_str();
  app.add_option("--into", document, "A document whose first block of ``` takes what is printed");
  app.add_option("--most-voxels", most_voxels, "Of the largest world")->capture_default_str();
  app.add_option("--most-segments", most_segments, "Of the largest growth");
  app.add_option("--most-attractors", most_attractors, "Of the largest front");
  app.add_option("--rows", rows, "Only these of 1 .. 15")->check(CLI::Range(1, 15));
  CLI11_PARSE(app, argc, argv);
  const auto wanted = [&](int row) { return rows.empty() || rows.contains(row); };
  try {
    bench::Report report(bench::machineText());
    report.note(bench::loadText());
    const scenes::Scene scene = gardenWall();
    scenes::Site site = scenes::makeSite(scene);
    if (wanted(1)) bench::benchSurfaces(scene, site, report);
    if (wanted(2)) bench::benchEveryVoxel(scene, site, report);
    if (wanted(3)) bench::benchLargeWorlds(most_voxels, report);
    if (wanted(4)) bench::benchGrowth(scene, site, report);
    if (wanted(5)) bench::benchSegments(most_segments, report);
    if (wanted(6)) bench::benchMemory(most_segments, report);
    if (wanted(7)) bench::benchForetold(report);
    if (wanted(8)) bench::benchFront(most_attractors, report);
    if (wanted(9)) bench::benchStems(report);
    if (wanted(10)) bench::benchLaying(report);
    if (wanted(11)) bench::benchBounced(report);
    if (wanted(12)) bench::benchBranching(report);
    if (wanted(13)) bench::benchPieces(report);
    if (wanted(14)) bench::benchHeights(report);
    if (wanted(15)) bench::benchStudio(report);
    report.writeCsv(csv);
    if (!document.empty()) report.writeInto(document);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench: {}\n", error.what());
    return 1;
  }
  return 0;
}
