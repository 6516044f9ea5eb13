#include "scenes/write/output_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <ostream>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/whole_file.h"

namespace espalier::scenes {

OutputFile fileOf(std::string name, std::function<std::string()> bytes) {
  return {std::move(name), [bytes = std::move(bytes)](std::ostream& out) { out << bytes(); }};
}

OutputFile fileOf(std::string name, std::string bytes) {
  return {std::move(name), [bytes = std::make_shared<const std::string>(std::move(bytes))](
                               std::ostream& out) { out << *bytes; }};
}

namespace fs = std::filesystem;

OutputFolder::OutputFolder(const fs::path& folder, std::vector<std::string> names,
                           std::span<const fs::path> read)
    : claim_(folder), names_(std::move(names)) {
  protect(read);
  // Where nobody knows who writes here, processes of other machines do not show either.
  if (claim_.certain()) sim::removeLeftovers(folder);
  const sim::NewFile trial(folder / "trial", [](std::ostream&) {});
}

void OutputFolder::protect(std::span<const fs::path> read) {
  read_.insert(read_.end(), read.begin(), read.end());
  for (const std::string& name : names_) requireFree(name);
}

void OutputFolder::requireFree(const std::string& name) const {
  const fs::path file = path() / name;
  std::error_code none;
  const fs::file_status there = fs::status(file, none);
  if (!fs::exists(there)) return;
  if (!fs::is_regular_file(there)) {
    throw sim::InputError(fmt::format(
        "{}: this is no file, and cannot be written over; expected another output folder", file.string()));
  }
  const auto same = [&](const fs::path& read) { return fs::equivalent(read, file, none); };
  if (std::none_of(read_.begin(), read_.end(), same)) return;
  throw sim::InputError(fmt::format(
      "{}: this run reads the file and would write over it; expected another output folder", file.string()));
}

void OutputFolder::write(const std::vector<OutputFile>& files) const {
  for (const OutputFile& file : files) requireFree(file.name);
  std::vector<std::unique_ptr<sim::NewFile>> made(files.size());
  sim::parallelForEach(files.size(), [&](std::size_t i) {
    made[i] = std::make_unique<sim::NewFile>(path() / files[i].name, files[i].write);
  });
  for (const auto& file : made) file->putInPlace();
}

}  // namespace espalier::scenes
