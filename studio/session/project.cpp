#include "studio/session/project.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

#include "scenes/clean_text.h"
#include "scenes/problem.h"
#include "scenes/read/read_scene.h"
#include "scenes/read/rule_library.h"
#include "scenes/yaml/yaml_text.h"
#include "sim/base/error.h"
#include "sim/base/hasher.h"
#include "sim/base/provenance.h"
#include "sim/base/whole_file.h"

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

/// Nothing where it cannot be read as a text.
std::optional<std::string> textOnDisk(const fs::path& path) {
  scenes::Problems problems;
  const scenes::Place whole{std::make_shared<const std::string>(path.string()), 0, 0};
  return scenes::readText(path.string(), whole, problems);
}

std::string hashOfText(const std::string& text) {
  return sim::hexOf(sim::hashOf(text));
}

std::pair<std::uintmax_t, std::int64_t> stampOf(const fs::path& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  return {size, fs::last_write_time(path, error).time_since_epoch().count()};
}

}  // namespace

Project::Project(const fs::path& scene) {
  const fs::path path = scenes::canonicalOf(scene);
  scenes::Problems problems;
  const scenes::Place whole{std::make_shared<const std::string>(scene.string()), 0, 0};
  const auto text = scenes::readText(path.string(), whole, problems);
  if (!text) throw scenes::PlacedError(problems.sorted());
  files_.push_back(
      {scenes::cleanText(path.filename().string()), path, true, false, *text, hashOfText(*text)});
  stamps_[path.string()] = stampOf(path);
}

const OpenFile& Project::file(const std::string& name) const {
  const auto at =
      std::find_if(files_.begin(), files_.end(), [&](const OpenFile& file) { return file.name == name; });
  if (at == files_.end()) throw sim::InputError("no file of the project is called " + scenes::inQuotes(name));
  return *at;
}

OpenFile& Project::fileToWrite(const std::string& name) {
  const OpenFile& found = file(name);
  if (found.library)
    throw sim::InputError(name + " is a part of the program; expected a file of the project to write to");
  return files_[static_cast<std::size_t>(&found - files_.data())];
}

std::string Project::nameOf(const std::string& path) const {
  if (path.empty()) return files_.front().name;
  if (scenes::isLibraryPath(path)) return path;
  const std::string canonical = scenes::canonicalOf(path);
  for (const OpenFile& file : files_) {
    if (file.path == canonical) return file.name;
  }
  return scenes::toldFrom(scene(), canonical, false);
}

scenes::OpenTexts Project::texts() const {
  scenes::OpenTexts texts;
  for (const OpenFile& file : files_) {
    if (!file.library) texts[file.path.string()] = file.text;
  }
  return texts;
}

void Project::write(const std::string& name, std::string text) {
  OpenFile& file = fileToWrite(name);
  if (text.size() > scenes::kMaxTextBytes)
    throw sim::InputError(
        fmt::format("{} is too large; expected at most {} bytes", name, scenes::kMaxTextBytes));
  file.text = std::move(text);
}

bool Project::take(const scenes::Scene& scene) {
  if (scene.read_files.empty()) return false;
  std::vector<OpenFile> files{files_.front()};
  std::size_t path = 0;
  for (const sim::InputFile& read : scene.read_files) {
    const bool of_library = scenes::isLibraryPath(read.name);
    const fs::path at = of_library ? fs::path(read.name) : scene.read_paths[path++];
    if (read.kind != "rules") continue;
    const fs::path canonical = of_library ? at : fs::path(scenes::canonicalOf(at));
    const auto same = [&](const OpenFile& file) { return file.path == canonical; };
    if (std::any_of(files.begin(), files.end(), same)) continue;
    if (const auto known = std::find_if(files_.begin(), files_.end(), same); known != files_.end()) {
      files.push_back(*known);
    } else if (of_library) {
      const scenes::LibraryRules* const rules = scenes::libraryRules(scenes::nameInLibrary(read.name));
      files.push_back({read.name, at, false, true, rules ? std::string(rules->text) : "", ""});
    } else if (const auto text = textOnDisk(canonical)) {
      files.push_back({read.name, canonical, false, false, *text, hashOfText(*text)});
      stamps_[canonical.string()] = stampOf(canonical);
    }
  }
  for (const OpenFile& file : files_) {
    const auto same = [&](const OpenFile& other) { return other.path == file.path; };
    if (std::none_of(files.begin(), files.end(), same) && !file.library &&
        hashOfText(file.text) != file.saved)
      files.push_back(file);
  }
  const bool others = !std::equal(files.begin(), files.end(), files_.begin(), files_.end(),
                                  [](const OpenFile& a, const OpenFile& b) { return a.path == b.path; });
  files_ = std::move(files);
  return others;
}

void Project::requireOurs(const OpenFile& file) const {
  if (file.scene) return;
  const fs::path folder = scene().parent_path();
  const auto on_disk = scenes::readScene(scene());
  for (const fs::path& named : on_disk ? on_disk->read_paths : std::vector<fs::path>()) {
    if (scenes::canonicalOf(named) != file.path.string()) continue;
    const bool by_link = fs::absolute(named).lexically_normal() != file.path;
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.path.begin(), file.path.end());
    if (!by_link || end == folder.end()) return;
    throw sim::InputError(file.name + " is a link out of the scene's folder; expected a file to save into");
  }
  throw sim::InputError(file.name +
                        " is named by no scene that is saved; expected the scene to be saved first");
}

std::optional<std::string> Project::save(const std::string& name, const std::string& text,
                                         const std::string& saved) {
  OpenFile& file = fileToWrite(name);
  requireOurs(file);
  const auto on_disk = textOnDisk(file.path);
  if (on_disk && hashOfText(*on_disk) != saved) {
    file.saved = hashOfText(*on_disk);
    stamps_[file.path.string()] = stampOf(file.path);
    return *on_disk;
  }
  sim::writeWhole(file.path, text);
  file.saved = hashOfText(text);
  told_.erase(file.path.string());
  stamps_[file.path.string()] = stampOf(file.path);
  return std::nullopt;
}

std::vector<Project::Changed> Project::changedOnDisk() {
  std::vector<Changed> changed;
  for (OpenFile& file : files_) {
    if (file.library) continue;
    auto& stamp = stamps_[file.path.string()];
    const auto now = stampOf(file.path);
    if (now == stamp) continue;
    stamp = now;
    const auto text = textOnDisk(file.path);
    if (!text) continue;
    const std::string hash = hashOfText(*text);
    std::string& told = told_[file.path.string()];
    if (hash == file.saved || hash == told) continue;
    told = hash;
    changed.push_back({file.name, hash, *text});
  }
  return changed;
}

}  // namespace espalier::studio
