#include "scenes/write/output_files.h"

#include <fmt/format.h>

#include <memory>
#include <ostream>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/whole_file.h"

namespace espalier::scenes {

OutputFile fileOf(std::string name, std::function<std::string()> bytes) {
  return {std::move(name), [bytes = std::move(bytes)](std::ostream& out) { out << bytes(); }};
}

void writeAll(const std::filesystem::path& folder, const std::vector<OutputFile>& files) {
  std::error_code error;
  const bool is_new = std::filesystem::create_directories(folder, error);
  if (error)
    throw sim::InputError(fmt::format("{}: cannot make the folder: {}", folder.string(), error.message()));
  sim::removeLeftovers(folder);
  std::vector<std::unique_ptr<sim::NewFile>> made(files.size());
  try {
    sim::parallelForEach(files.size(), [&](std::size_t i) {
      made[i] = std::make_unique<sim::NewFile>(folder / files[i].name, files[i].write);
    });
  } catch (...) {
    made.clear();
    if (is_new) std::filesystem::remove(folder, error);
    throw;
  }
  for (const auto& file : made) file->putInPlace();
}

}  // namespace espalier::scenes
