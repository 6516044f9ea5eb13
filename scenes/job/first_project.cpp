#include "scenes/job/first_project.h"

#include <fmt/format.h>

#include <memory>
#include <ostream>
#include <utility>

#include "scenes/job/first_project_files.h"
#include "scenes/read/json_schema.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;

void requireRoomFor(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (status.type() == fs::file_type::not_found) return;
  if (!fs::is_directory(status))
    throw sim::InputError(
        fmt::format("{}: it is no folder; expected a new folder, or an empty one", folder.string()));
  const bool empty = fs::is_empty(folder, error);
  if (error) throw sim::InputError(fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
  if (!empty)
    throw sim::InputError(
        fmt::format("{}: it is not empty; expected a new folder, or an empty one", folder.string()));
}

}  // namespace

std::vector<std::string> makeFirstProject(const fs::path& folder) {
  requireRoomFor(folder);
  std::vector<std::pair<std::string, std::string>> contents;
  for (const FirstProjectFile& file : firstProjectFiles()) contents.emplace_back(file.name, file.text);
  contents.emplace_back("schemas/scene.json", schemaFor(FileKind::scene));
  contents.emplace_back("schemas/rules.json", schemaFor(FileKind::rules));
  std::vector<std::unique_ptr<sim::NewFolder>> folders;
  std::vector<std::unique_ptr<sim::NewFile>> files;
  std::vector<std::string> names;
  for (const auto& [name, text] : contents) {
    const fs::path path = folder / name;
    folders.push_back(std::make_unique<sim::NewFolder>(path.parent_path()));
    files.push_back(std::make_unique<sim::NewFile>(path, [&text = text](std::ostream& out) { out << text; }));
    names.push_back(name);
  }
  for (const auto& file : files) file->putInPlace();
  return names;
}

}  // namespace espalier::scenes
