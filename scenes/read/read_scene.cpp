#include "scenes/read/read_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <system_error>

#include "scenes/clean_text.h"
#include "scenes/read/asked_scenes.h"
#include "scenes/read/document.h"
#include "scenes/read/read_table.h"
#include "scenes/read/registry.h"
#include "scenes/read/rule_library.h"
#include "scenes/read/rule_loader.h"
#include "scenes/read/scene_places.h"
#include "scenes/yaml/yaml_text.h"

namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;

void fillNames(Scene& scene) {
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    SceneMesh& mesh = scene.meshes[i];
    if (!mesh.name.empty()) continue;
    mesh.name = !mesh.from.empty()  ? (mesh.product.empty() ? mesh.from.stem().string() : mesh.product)
                : mesh.file.empty() ? fmt::format("lines_{}", i + 1)
                                    : mesh.file.stem().string();
  }
  for (std::size_t i = 0; i < scene.plants.size(); ++i) {
    if (scene.plants[i].name.empty()) scene.plants[i].name = fmt::format("plant_{}", i + 1);
  }
  for (auto& image : scene.images) {
    if (image.name.empty()) image.name = nameOf(image.kind);
  }
}

/// Whether a file's name ends in one of these, in letters of any case.
bool endsIn(const fs::path& file, std::initializer_list<std::string_view> endings) {
  auto ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

/// Turns the meshes' paths, so far as the file has them, into paths from here.
void findMeshes(Scene& scene, const YamlNode& root, const rules::Check::Complain& complain) {
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    auto& mesh = scene.meshes[i];
    if (mesh.file.empty()) continue;
    const auto key = fmt::format("meshes[{}].file", i);
    const auto written = mesh.file.string();
    mesh.file = beside(root, written);
    mesh.told = toldFrom(scene.file, mesh.file, fs::path(written).is_absolute());
    std::error_code error;
    if (!endsIn(mesh.file, {".obj", ".gltf", ".glb", ".ply", ".stl"})) {
      complain(key, fmt::format("{} is no mesh file that is known; expected .obj, .gltf, .glb, .ply or .stl",
                                inQuotes(written)));
    } else if (!mesh.optional && !fs::is_regular_file(mesh.file, error)) {
      complain(key,
               fmt::format("there is no mesh file {}; expected one, or optional: true", mesh.file.string()));
    }
  }
}

/// The same for tables of points.
void findPoints(Scene& scene, const YamlNode& root, const rules::Check::Complain& complain) {
  forEachTable(scene, [&](PointTable& table, const std::string& path) {
    if (table.file.empty()) return;
    const auto key = path + ".points";
    const auto written = table.file.string();
    table.file = beside(root, written);
    table.told = toldFrom(scene.file, table.file, fs::path(written).is_absolute());
    std::error_code error;
    if (table.file.extension() != ".csv") {
      complain(key, fmt::format("{} is no table of points; expected a .csv file", inQuotes(written)));
    } else if (!fs::is_regular_file(table.file, error)) {
      complain(key, fmt::format("there is no table of points {}; expected one", table.file.string()));
    }
  });
}

/// The same for volumes.
void findVolumes(Scene& scene, const YamlNode& root, const rules::Check::Complain& complain) {
  for (FieldSpec& field : scene.fields) {
    if (field.file.empty()) continue;
    const auto key = fmt::format("fields.{}.file", field.name);
    const auto written = field.file.string();
    field.file = beside(root, written);
    field.told = toldFrom(scene.file, field.file, fs::path(written).is_absolute());
    std::error_code error;
    if (field.file.extension() != ".vdb") {
      complain(key, fmt::format("{} is no volume that is known; expected a .vdb file", inQuotes(written)));
    } else if (!fs::is_regular_file(field.file, error)) {
      complain(key, fmt::format("there is no volume {}; expected one", field.file.string()));
    }
  }
}

/// The same for a picture under `key`.
void findPicture(fs::path& file, std::string& told, const std::string& key, const Scene& scene,
                 const YamlNode& root, const rules::Check::Complain& complain) {
  if (file.empty()) return;
  const auto written = file.string();
  file = beside(root, written);
  told = toldFrom(scene.file, file, fs::path(written).is_absolute());
  std::error_code error;
  if (!endsIn(file, {".exr", ".hdr", ".png", ".jpg", ".jpeg"})) {
    complain(key, fmt::format("{} is no picture that is known; expected .exr, .hdr, .png or .jpg",
                              inQuotes(written)));
  } else if (!fs::is_regular_file(file, error)) {
    complain(key, fmt::format("there is no picture {}; expected one", file.string()));
  }
}

/// The same for the pictures of the sky and of attractors.
void findPictures(Scene& scene, const YamlNode& root, const rules::Check::Complain& complain) {
  BackgroundSpec& background = scene.sky.background;
  findPicture(background.file, background.told, "sky.background.file", scene, root, complain);
  for (AttractorsSpec& attractors : scene.attractors) {
    if (attractors.picture)
      findPicture(attractors.picture->file, attractors.picture->told,
                  "attractors." + attractors.name + ".picture.file", scene, root, complain);
  }
}

/// The same for skeletons.
void findSkeletons(Scene& scene, const YamlNode& root, const rules::Check::Complain& complain) {
  for (std::size_t i = 0; i < scene.plants.size(); ++i) {
    if (!scene.plants[i].skeleton || scene.plants[i].skeleton->file.empty()) continue;
    SkeletonSpec& skeleton = *scene.plants[i].skeleton;
    const auto key = fmt::format("plants[{}].skeleton.file", i);
    const auto written = skeleton.file.string();
    skeleton.file = beside(root, written);
    skeleton.told = toldFrom(scene.file, skeleton.file, fs::path(written).is_absolute());
    std::error_code error;
    if (!endsIn(skeleton.file, {".json", ".obj"})) {
      complain(key,
               fmt::format("{} is no skeleton that is known; expected .json or .obj", inQuotes(written)));
    } else if (!fs::is_regular_file(skeleton.file, error)) {
      complain(key, fmt::format("there is no skeleton {}; expected one", skeleton.file.string()));
    }
  }
}

/// The same for scenes whose products are asked for.
void findAsked(Scene& scene, const YamlNode& root) {
  const auto ask = [&](fs::path& from, std::string& told, const std::string& product, ProductKind kind,
                       const std::string& key) {
    if (from.empty()) return;
    const bool from_root = from.is_absolute();
    from = beside(root, from.string());
    told = toldFrom(scene.file, from, from_root);
    scene.asks.push_back({from, product, kind, placeOf({&root}, key)});
  };
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    SceneMesh& mesh = scene.meshes[i];
    ask(mesh.from, mesh.told, mesh.product, ProductKind::mesh, fmt::format("meshes[{}].from", i));
  }
  for (AttractorsSpec& attractors : scene.attractors) {
    if (attractors.picture)
      ask(attractors.picture->from, attractors.picture->told, attractors.picture->product,
          ProductKind::picture, fmt::format("attractors.{}.picture.from", attractors.name));
  }
  for (std::size_t i = 0; i < scene.plants.size(); ++i) {
    auto& skeleton = scene.plants[i].skeleton;
    if (skeleton)
      ask(skeleton->from, skeleton->told, "", ProductKind::skeleton,
          fmt::format("plants[{}].skeleton.from", i));
  }
}

Scene sceneOf(const Document& document, const fs::path& path, AskedScenes& asked, Problems& problems,
              const OpenTexts& texts = {}) {
  const AskedScenes::Open open(asked, path);
  const YamlNode& root = *document.root;
  static const auto paths = pathsOf(sceneTable());
  Scene scene;
  scene.file = path;
  RuleLoader loader(problems, texts);
  Reading reading{problems, paths};
  reading.special = [&](const YamlNode& node, const rules::Key& key, void* target, const std::string& at) {
    if (key.kind != rules::Kind::rules) return;
    const bool in_file = node.kind == YamlNode::Kind::scalar;
    rules::RuleReference reference{in_file ? ruleFileOf(node).string() : "", loader.reference(node, at, {})};
    if (reference.rules) {
      key.set(target, reference);
    } else {
      reading.failed.insert(at);
    }
  };
  readTable(root, sceneTable(), &scene, "", reading);
  auto checks = sceneChecks();
  checks.push_back(
      {{}, [&](const void*, const auto&, const auto& complain) { findMeshes(scene, root, complain); }});
  checks.push_back(
      {{}, [&](const void*, const auto&, const auto& complain) { findPoints(scene, root, complain); }});
  checks.push_back(
      {{}, [&](const void*, const auto&, const auto& complain) { findVolumes(scene, root, complain); }});
  checks.push_back(
      {{}, [&](const void*, const auto&, const auto& complain) { findSkeletons(scene, root, complain); }});
  checks.push_back(
      {{}, [&](const void*, const auto&, const auto& complain) { findPictures(scene, root, complain); }});
  fillNames(scene);
  scene.region_mentions = loader.mentions();
  scene.read_files.push_back({cleanText(path.filename().string()), "scene", document.hash});
  scene.read_paths.push_back(path);
  for (const auto& read : loader.readFiles()) {
    const bool of_library = isLibraryPath(read.path.string());
    scene.read_files.push_back(
        {of_library ? read.path.string() : toldFrom(path, read.path, read.from_root), read.kind, read.hash});
    if (!of_library) scene.read_paths.push_back(read.path);
  }
  for (const SceneMesh& mesh : scene.meshes) {
    if (!mesh.file.empty()) scene.read_paths.push_back(mesh.file);
  }
  scene.warnings = loader.warnings().sorted();
  notePlaces(scene, root);
  runChecks(checks, &scene, {&root}, reading);
  findAsked(scene, root);
  scene.asks.insert(scene.asks.end(), loader.asks().begin(), loader.asks().end());
  asked.require(scene.asks, problems);
  return scene;
}

Result<Scene> sceneOrProblems(const Document& document, const fs::path& path, AskedScenes& asked,
                              Problems& problems, const OpenTexts& open = {}) {
  if (!document.root) return problems.sorted();
  auto scene = sceneOf(document, path, asked, problems, open);
  if (!problems.empty()) return problems.sorted();
  return scene;
}

Result<Scene> readWith(const fs::path& path, AskedScenes& asked, const OpenTexts& open) {
  Problems problems;
  return sceneOrProblems(readDocument(path, FileKind::scene, problems, open), path, asked, problems, open);
}

/// Of files alone.
Result<Scene> readAsked(const fs::path& path, AskedScenes& asked) {
  return readWith(path, asked, {});
}

Result<RulesOrScene> rulesOrScene(const Document& document, const fs::path& path, Problems& problems) {
  AskedScenes asked(readAsked);
  const auto kind = document.root ? headerOf(*document.root, problems) : std::nullopt;
  RulesOrScene read;
  if (kind == FileKind::scene) {
    read.scene = sceneOf(document, path, asked, problems);
    read.warnings = read.scene->warnings;
  }
  if (kind == FileKind::rules) {
    RuleLoader loader(problems);
    loader.file(path, document);
    asked.require(loader.asks(), problems);
    read.warnings = loader.warnings().sorted();
  }
  if (!problems.empty()) return problems.sorted();
  return read;
}

Place wholeFile(const fs::path& path) {
  return {std::make_shared<const std::string>(path.string()), 0, 0};
}

}  // namespace

Result<Scene> readScene(const fs::path& path, const OpenTexts& open) {
  AskedScenes asked(
      [&open](const fs::path& other, AskedScenes& others) { return readWith(other, others, open); });
  return readWith(path, asked, open);
}

Scene filesOfScene(const fs::path& path, const OpenTexts& open) {
  Problems problems;
  const Document document = readDocument(path, FileKind::scene, problems, open);
  Scene files;
  if (!document.root) return files;
  AskedScenes asked(
      [&open](const fs::path& other, AskedScenes& others) { return readWith(other, others, open); });
  Scene scene = sceneOf(document, path, asked, problems, open);
  files.file = path;
  files.read_files = std::move(scene.read_files);
  files.read_paths = std::move(scene.read_paths);
  return files;
}

Result<Scene> readSceneText(const std::string& text, const fs::path& path) {
  Problems problems;
  const Document document = documentOf(text, path.string(), wholeFile(path), FileKind::scene, problems);
  AskedScenes asked(readAsked);
  return sceneOrProblems(document, path, asked, problems);
}

Result<RulesOrScene> readRulesOrScene(const fs::path& path) {
  Problems problems;
  return rulesOrScene(readDocument(path, std::nullopt, problems), path, problems);
}

Result<RulesOrScene> readRulesOrSceneText(std::string text, const fs::path& path) {
  Problems problems;
  const Place whole = wholeFile(path);
  if (text.size() > kMaxTextBytes) {
    problems.add(whole, fmt::format("is too large; expected at most {} bytes", kMaxTextBytes));
    return problems.sorted();
  }
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  return rulesOrScene(documentOf(text, path.string(), whole, std::nullopt, problems), path, problems);
}

}  // namespace espalier::scenes
