#include "studio/session/touched.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <system_error>

#include "scenes/job/saved_growth.h"
#include "scenes/read/settings.h"

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

bool begins(std::string_view path, std::initializer_list<std::string_view> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) {
    return path.starts_with(key) &&
           (path.size() == key.size() || path[key.size()] == '.' || path[key.size()] == '[');
  });
}

/// Of plants and attractors: what is read from files.
bool isOfFiles(std::string_view path) {
  if (path.find(".rules.") != path.npos) return false;
  const auto has = [&](std::string_view key) { return path.find(key) != path.npos; };
  return begins(path, {"plants", "attractors"}) && (has(".points") || has(".picture") || has(".skeleton"));
}

bool isOfLooks(std::string_view path) {
  return path.starts_with("plants[") && (path.ends_with(".colour") || path.find(".emits") != path.npos);
}

template <class Wanted>
std::string chosen(const scenes::Settings& settings, Wanted wanted) {
  std::string text;
  for (const auto& [path, value] : settings) {
    if (wanted(path)) text += fmt::format("{}: {}\n", path, value);
  }
  return text;
}

void addStamp(std::string& text, const fs::path& file) {
  if (file.empty()) return;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  const auto time = fs::last_write_time(file, error).time_since_epoch().count();
  text += fmt::format("{} {} {}\n", file.string(), size, time);
}

}  // namespace

std::string tilingText(const scenes::Scene& scene) {
  std::string text = chosen(scenes::settings(scene), [](std::string_view path) {
    return begins(path, {"meshes", "world", "fields", "sky.background"}) || isOfFiles(path);
  });
  for (const scenes::SceneMesh& mesh : scene.meshes) addStamp(text, mesh.file);
  forEachTable(scene,
               [&](const scenes::PointTable& table, const std::string&) { addStamp(text, table.file); });
  for (const scenes::AttractorsSpec& attractors : scene.attractors) {
    if (attractors.picture) addStamp(text, attractors.picture->file);
  }
  for (const scenes::FieldSpec& field : scene.fields) addStamp(text, field.file);
  for (const scenes::PlantSpec& plant : scene.plants) {
    if (plant.skeleton) addStamp(text, plant.skeleton->file);
  }
  addStamp(text, scene.sky.background.file);
  return text;
}

std::string lightText(const scenes::Scene& scene) {
  return chosen(scenes::settings(scene), [](std::string_view path) {
    return begins(path, {"sky", "sun", "seed"});
  });
}

std::string growthText(const scenes::Scene& scene, const scenes::Site& site) {
  std::string text = fmt::format("iterations: {}\nlayers: {}\n", scene.iterations, site.world.layers());
  for (const auto& [path, value] : scenes::inputsOf(scene, site)) {
    if (!isOfLooks(path)) text += fmt::format("{}: {}\n", path, value);
  }
  return text;
}

std::string looksText(const scenes::Scene& scene) {
  return chosen(scenes::settings(scene), [](std::string_view path) { return path.starts_with("plants["); });
}

}  // namespace espalier::studio
