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

}  // namespace espalier::scenes
