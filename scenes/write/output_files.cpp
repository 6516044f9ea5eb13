#include "scenes/write/output_files.h"

#include <fmt/format.h>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/whole_file.h"

namespace espalier::scenes {

void writeAll(const std::filesystem::path& folder, const std::vector<OutputFile>& files) {
  std::vector<std::string> bytes(files.size());
  sim::parallelForEach(files.size(), [&](std::size_t i) { bytes[i] = files[i].bytes(); });
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw sim::InputError(fmt::format("{}: cannot make the folder: {}", folder.string(), error.message()));
  sim::removeLeftovers(folder);
  sim::parallelForEach(files.size(),
                       [&](std::size_t i) { sim::writeWhole(folder / files[i].name, bytes[i]); });
}

void writeReport(const std::filesystem::path& folder, const std::vector<OutputFile>& files, Report& report) {
  for (const OutputFile& file : files) report.files.push_back(file.name);
  report.files.emplace_back("report.json");
  report.run.peak_memory_bytes = peakMemoryBytes();
  report.run.threads = sim::threadCount();
  sim::writeWhole(folder / "report.json", toJson(report));
}

std::string endOfSummary(const Report& report, const std::filesystem::path& folder) {
  std::string text;
  for (const auto& fill : report.fills) {
    if (fill.doubtful > 0) {
      text += fmt::format("note: '{}' leaks; {} of {} voxels inside are doubtful\n", fill.object,
                          fill.doubtful, fill.filled);
    }
  }
  std::string stages;
  for (const auto& [name, seconds] : report.run.stages_s) stages += fmt::format(", {} {:.2f}", name, seconds);
  text += fmt::format("{:.2f} s ({}), {:.0f} MB", report.run.total_s, stages.substr(2),
                      static_cast<double>(report.run.peak_memory_bytes) / 1e6);
  if (report.growth) text += fmt::format(", state {:016x}", report.growth->state_hash);
  text += "\nwrote\n";
  for (const std::string& file : report.files) text += "  " + (folder / file).string() + "\n";
  return text;
}

}  // namespace espalier::scenes
