#include "scenes/job/saved_growth.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>

#include "rules/growth/front_memory.h"
#include "rules/growth/shared_guide.h"
#include "scenes/problem.h"
#include "scenes/read/settings.h"
#include "sim/base/error.h"
#include "sim/base/hasher.h"

namespace espalier::scenes {
namespace {

bool startsWith(std::string_view path, std::initializer_list<std::string_view> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) {
    return path.starts_with(key) &&
           (path.size() == key.size() || path[key.size()] == '.' || path[key.size()] == '[');
  });
}

/// Where a mesh, a table of points or a volume lies does not matter, what it holds does.
bool namesAFile(std::string_view path) {
  return (path.starts_with("meshes[") && (path.ends_with("].file") || path.ends_with("].optional"))) ||
         ((path.starts_with("attractors.") || path.starts_with("plants[")) && path.ends_with(".points")) ||
         (path.starts_with("attractors.") && path.ends_with(".picture.file")) ||
         (path.starts_with("plants[") && path.ends_with(".skeleton.file")) ||
         (path.starts_with("fields.") && path.ends_with(".file")) || path == "sky.background.file";
}

std::string difference(const std::string& path, const std::string* was, const std::string* is) {
  const auto shown = [](const std::string* value) { return value != nullptr ? inQuotes(*value) : "nothing"; };
  if (path.ends_with(".contents")) return fmt::format("{} are others", path);
  return fmt::format("{} is {}, was {}", path, shown(is), shown(was));
}

/// What differs between what a state was grown from and what there is now.
std::vector<std::string> differences(const sim::Inputs& was, const sim::Inputs& is, Same same) {
  std::map<std::string, std::pair<const std::string*, const std::string*>> both;
  std::vector<std::string> order;
  const auto note = [&](const sim::Inputs& inputs, auto pick) {
    for (const auto& [path, value] : inputs) {
      if (same == Same::plants && !startsWith(path, {"meshes", "world", "plants"})) continue;
      const auto [at, fresh] = both.try_emplace(path, nullptr, nullptr);
      if (fresh) order.push_back(path);
      pick(at->second) = &value;
    }
  };
  note(
      is, [](auto& pair) -> auto& { return pair.second; });
  note(
      was, [](auto& pair) -> auto& { return pair.first; });
  std::vector<std::string> found;
  for (const std::string& path : order) {
    const auto [old_value, new_value] = both.at(path);
    if (old_value == nullptr || new_value == nullptr || *old_value != *new_value)
      found.push_back(difference(path, old_value, new_value));
  }
  return found;
}

/// Some of them, a line each.
std::vector<std::string> told(const std::vector<std::string>& differences) {
  constexpr std::size_t kMost = 4;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < std::min(kMost, differences.size()); ++i)
    lines.push_back("  " + differences[i]);
  if (differences.size() > kMost) lines.push_back(fmt::format("  and {} more", differences.size() - kMost));
  return lines;
}

constexpr std::array<std::string_view, 18> kLooks{
    ".stem.shoots",   ".opacity",         ".stem.order_share", ".stem.emits.order_share",
    ".rough.hurst",   ".rough.amplitude", ".rough.over",       ".rough.detail",
    ".stem.forks",    ".stem.by",         ".stem.exponent",    ".stem.thickens",
    ".stem.thickest", ".stem.texture",    ".varies.chance",    ".varies.age",
    ".varies.light",  ".varies.height"};

/// How thick stems are beyond their twigs is for models alone, and so are what is painted on them, how far
/// leaves differ, and what is seen through.
bool ofLooksAlone(const std::string& path) {
  return std::any_of(kLooks.begin(), kLooks.end(), [&](std::string_view key) { return path.ends_with(key); });
}

sim::InputError damaged(const std::filesystem::path& folder, const sim::BrokenContract& how) {
  return sim::InputError(
      fmt::format("{}: the state is damaged: {}", (folder / kStateFile).string(), how.what()));
}

}  // namespace

sim::Inputs inputsOf(const Scene& scene, const Site& site) {
  sim::Inputs inputs = {{"espalier", ESPALIER_VERSION}};
  for (auto& [path, value] : settings(scene)) {
    if (startsWith(path, {"name", "iterations", "image", "images", "pieces", "heights", "film", "cameras",
                          "exposure", "sun.shadow_hour", "sun.brightness", "sky.brightness", "sky.tint"}) ||
        namesAFile(path) || ofLooksAlone(path))
      continue;
    inputs.emplace_back(path, value);
  }
  std::size_t tiled = 0, shapes = 0;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const sim::Mesh& mesh = scene.meshes[i].tiled ? site.meshes[tiled++].mesh : site.shapes[shapes++];
    inputs.emplace_back(fmt::format("meshes[{}].contents", i),
                        fmt::format("{:016x}", sim::contentHash(mesh)));
  }
  auto listed = site.listed_m.begin();
  forEachTable(scene, [&](const PointTable& table, const std::string& path) {
    const std::vector<sim::Vec3>& points = *listed++;
    if (table.file.empty()) return;
    sim::Hasher hash;
    hash.add(points);
    inputs.emplace_back(path + ".contents", fmt::format("{:016x}", hash.digest()));
  });
  for (std::size_t i = 0; i < scene.attractors.size(); ++i) {
    if (!site.densities[i]) continue;
    sim::Hasher hash;
    hash.add(site.densities[i]->width);
    hash.add(site.densities[i]->density);
    inputs.emplace_back("attractors." + scene.attractors[i].name + ".picture.contents",
                        fmt::format("{:016x}", hash.digest()));
  }
  for (std::size_t i = 0; i < scene.plants.size(); ++i) {
    if (!scene.plants[i].skeleton) continue;
    sim::Hasher hash;
    for (const FileTree& tree : site.skeletons[i]) {
      hash.add(tree.parent);
      hash.add(tree.position);
      hash.add(tree.radius);
    }
    inputs.emplace_back(fmt::format("plants[{}].skeleton.contents", i),
                        fmt::format("{:016x}", hash.digest()));
  }
  // How fast given skeletons grow; not among the keys of plants, as the plants are the same.
  if (std::any_of(scene.plants.begin(), scene.plants.end(),
                  [](const PlantSpec& p) { return p.skeleton.has_value(); }))
    inputs.emplace_back("skeletons.iterations",
                        fmt::format("{}", scene.skeleton_iterations.value_or(scene.iterations)));
  // How much of a leaf its picture leaves, and the shape of its card, follow from it.
  for (const sim::InputFile& read : scene.read_files) {
    if (read.kind == "picture")
      inputs.emplace_back(fmt::format("pictures.{}.contents", read.name), sim::hexOf(read.hash));
  }
  for (std::size_t i = 0; i < scene.fields.size(); ++i) {
    if (scene.fields[i].file.empty()) continue;
    const VectorLattice& grid = site.fields[i].grid;
    sim::Hasher hash;
    hash.add(grid.low_m);
    hash.add(grid.apart_m);
    for (const std::int32_t side : grid.size) hash.add(side);
    hash.add(grid.vectors);
    inputs.emplace_back(fmt::format("fields.{}.contents", scene.fields[i].name),
                        fmt::format("{:016x}", hash.digest()));
  }
  if (site.sky_picture) {
    sim::Hasher hash;
    hash.add(site.sky_picture->radiance);
    inputs.emplace_back("sky.background.contents", fmt::format("{:016x}", hash.digest()));
  }
  return inputs;
}

void dropState(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kStateFile;
  std::error_code error;
  std::filesystem::remove(path, error);
  if (error) throw sim::InputError(fmt::format("{}: cannot be removed: {}", path.string(), error.message()));
}

std::optional<sim::State> readKept(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kStateFile;
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return std::nullopt;
  if (status.type() == std::filesystem::file_type::none)
    throw sim::InputError(fmt::format("{}: cannot be read: {}", path.string(), error.message()));
  if (!std::filesystem::is_regular_file(status))
    throw sim::InputError(fmt::format("{}: is no file; expected a saved state", path.string()));
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw sim::InputError(fmt::format("{}: cannot be read", path.string()));
  return sim::readState(bytes, path.string());
}

std::optional<std::uint64_t> seedOf(const sim::State& state) {
  const auto at = std::find_if(state.inputs.begin(), state.inputs.end(),
                               [](const auto& input) { return input.first == "seed"; });
  std::uint64_t seed = 0;
  if (at == state.inputs.end()) return std::nullopt;
  const std::string& text = at->second;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return seed;
}

sim::Growth takeUp(sim::State state, const std::filesystem::path& folder, const Scene& scene, Site& site,
                   const std::vector<sim::Planting>& plantings, Same same) {
  const std::filesystem::path path = folder / kStateFile;
  const auto different = differences(state.inputs, inputsOf(scene, site), same);
  if (!different.empty()) {
    std::vector<std::string> lines = told(different);
    lines.insert(lines.begin(), fmt::format("{}: it was grown from something else than {} says now:",
                                            path.string(), scene.file.string()));
    throw ManyLines(std::move(lines));
  }
  const bool trials_wanted =
      std::any_of(scene.images.begin(), scene.images.end(),
                  [](const ImageSpec& image) { return image.kind == ImageKind::attempts; });
  if (trials_wanted && !state.growth.recorded) {
    throw sim::InputError(fmt::format(
        "{}: it keeps no record of trials, which an image of attempts shows; grow it anew with that image",
        path.string()));
  }
  if (!trials_wanted) {  // as a run of this scene keeps none
    state.growth.recorded = false;
    state.growth.attempts.clear();
  }
  try {
    rules::requireSoundFronts(state.growth.commons);
    for (const auto& [name, columns] : state.growth.commons) {
      if (name.starts_with(rules::fieldNamed(""))) rules::guideIn(columns);
    }
  } catch (const sim::BrokenContract& error) {
    throw damaged(folder, error);
  }
  return sim::restore(std::move(state), site.world, plantings, path.string());
}

std::unique_ptr<sim::Growing> goOnFrom(sim::Growth kept, const std::filesystem::path& folder,
                                       sim::World& world, const std::vector<sim::Planting>& plantings,
                                       const sim::GrowthSettings& settings) {
  try {
    auto growing = std::make_unique<sim::Growing>(world, plantings, settings, std::move(kept));
    static_cast<void>(growing->alive());
    static_cast<void>(growing->due());
    return growing;
  } catch (const sim::BrokenContract& error) {
    throw damaged(folder, error);
  }
}

}  // namespace espalier::scenes
