#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/base/error.h"
#include "tests/bench/rows.h"
#include "tests/bench/wall_scene.h"

namespace espalier::bench {

void benchForetold(Report& report) {
  namespace fs = std::filesystem;
  constexpr const char* kRow = "7 foretold";
  report.title("7. What the first line of a run foretells: by what factor it is off, either way");
  const fs::path folder = fs::temp_directory_path() / fmt::format("espalier.bench.{}", ::getpid());
  fs::create_directories(folder);
  writeWallScene(folder / "wall.yaml", 1e5);
  const std::string library = ESPALIER_SOURCE_DIR "/scenes/library/";
  double worst_s = 1.0, worst_bytes = 1.0;
  for (const std::string& job :
       {"grow " + library + "garden_wall.yaml", "grow " + library + "garden_wall.yaml --no-pictures",
        "grow " + library + "figure_3.yaml", "grow " + (folder / "wall.yaml").string(),
        "expose " + library + "street.yaml", "expose " + library + "garden_wall.yaml",
        "expose " + library + "figure_3.yaml", "expose " + library + "street.yaml --no-pictures"}) {
    const std::string line =
        fmt::format("'{}' {} -o '{}' >/dev/null 2>&1", ESPALIER_PROGRAM, job, (folder / "out").string());
    if (std::system(line.c_str()) != 0) throw sim::InputError(fmt::format("failed: {}", line));
    const auto run = nlohmann::json::parse(std::ifstream(folder / "out" / "report.json")).at("run");
    const auto off = [&](const char* what) {
      const double told = run.at("foretold").at(what), came = run.at(what);
      return std::max(told / came, came / told);
    };
    report.note(fmt::format("{}: {:.1f} s foretold, {:.1f} s taken; {:.0f} MB foretold, {:.0f} MB held",
                            job.substr(0, job.find(' ') + 1) + fs::path(job).filename().string(),
                            run.at("foretold").at("total_s").get<double>(), run.at("total_s").get<double>(),
                            run.at("foretold").at("peak_memory_bytes").get<double>() / 1e6,
                            run.at("peak_memory_bytes").get<double>() / 1e6));
    worst_s = std::max(worst_s, off("total_s"));
    worst_bytes = std::max(worst_bytes, off("peak_memory_bytes"));
  }
  fs::remove_all(folder);
  report.add({kRow, "  seconds, the worst of them", worst_s, "times", 0, Target{1.5, false}});
  report.add({kRow, "  memory, the worst of them", worst_bytes, "times", 0, Target{1.5, false}});
}

}  // namespace espalier::bench
