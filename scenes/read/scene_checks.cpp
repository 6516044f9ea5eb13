#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scenes/problem.h"
#include "scenes/read/attractor_checks.h"
#include "scenes/read/film_keys.h"
#include "scenes/read/heights_keys.h"
#include "scenes/read/light_keys.h"
#include "scenes/read/made_names.h"
#include "scenes/read/piece_keys.h"
#include "scenes/read/registry.h"
#include "scenes/scene.h"

namespace espalier::scenes {
namespace {

using rules::Check;
using Given = Check::Given;
using Complain = Check::Complain;

constexpr double kMostVoxels =
    1e11;  // more than fit any machine; what fits this one is found out when the world is built

Check check(std::vector<std::string> reads, void (*run)(const Scene&, const Given&, const Complain&)) {
  return {std::move(reads), [run](const void* scene, const Given& given, const Complain& complain) {
            run(*static_cast<const Scene*>(scene), given, complain);
          }};
}

void checkWorldSize(const Scene& scene, const Given&, const Complain& complain) {
  const auto& world = scene.world;
  if (world.voxel_m && world.resolution) {
    complain("world.resolution", "both voxel and resolution are given; expected one of them");
  } else if (!world.voxel_m && !world.resolution) {
    complain("world", "neither voxel nor resolution is given; expected voxel: 4 cm, or resolution: 200");
  }
}

void checkBounds(const Scene& scene, const Given& given, const Complain& complain) {
  if (!scene.world.bounds_m) return;
  const auto& [low, high] = *scene.world.bounds_m;
  for (int axis = 0; axis < 3; ++axis) {
    if (low[axis] < high[axis]) continue;
    complain("world.bounds.max",
             fmt::format("max.{0} is {1} and min.{0} is {2}; expected max to be more than min", "xyz"[axis],
                         high[axis], low[axis]));
    return;
  }
  if (given("world.margin"))
    complain("world.margin",
             "both bounds and margin are given; expected a margin only where the meshes make the bounds");
  if (!scene.world.voxel_m) return;
  const auto voxels = (high - low) / *scene.world.voxel_m;
  if (voxels.x * voxels.y * voxels.z <= kMostVoxels) return;
  complain("world.voxel",
           fmt::format(
               "voxels of {} m make a world of {:.3g}; expected at most {:.3g} voxels, so at least {:.2g} m",
               *scene.world.voxel_m, voxels.x * voxels.y * voxels.z, kMostVoxels,
               std::cbrt((high.x - low.x) * (high.y - low.y) * (high.z - low.z) / kMostVoxels)));
}

void checkSeeds(const Scene& scene, const Given&, const Complain& complain) {
  if (!scene.world.bounds_m) return;
  const auto& [low, high] = *scene.world.bounds_m;
  for (std::size_t p = 0; p < scene.plants.size(); ++p) {
    const auto& seeds = scene.plants[p].seeds;
    for (std::size_t s = 0; s < seeds.size(); ++s) {
      const sim::Vec3& at = seeds[s].at_m;
      if (glm::all(glm::greaterThanEqual(at, low)) && glm::all(glm::lessThanEqual(at, high))) continue;
      complain(fmt::format("plants[{}].seeds[{}].at", p, s),
               fmt::format("the seed [{}, {}, {}] lies outside the world; expected it within [{}, {}, {}] "
                           "and [{}, {}, {}]",
                           at.x, at.y, at.z, low.x, low.y, low.z, high.x, high.y, high.z));
    }
  }
}

void checkSeedKeys(const Scene& scene, const Given&, const Complain& complain) {
  for (std::size_t p = 0; p < scene.plants.size(); ++p) {
    const auto& seeds = scene.plants[p].seeds;
    std::set<std::string_view> seen;
    for (std::size_t s = 0; s < seeds.size(); ++s) {
      if (seeds[s].key.empty() || seen.insert(seeds[s].key).second) continue;
      complain(fmt::format("plants[{}].seeds[{}].key", p, s),
               fmt::format("a second seed of this plant has the key {}; expected keys that differ",
                           inQuotes(seeds[s].key)));
    }
  }
}

void checkMeshes(const Scene& scene, const Given&, const Complain& complain) {
  const bool none = std::none_of(scene.meshes.begin(), scene.meshes.end(),
                                 [](const SceneMesh& mesh) { return mesh.tiled; });
  if (none && !scene.world.bounds_m) {
    complain("meshes",
             "no mesh and no world.bounds; expected at least one mesh, or the bounds of an empty world");
  }
}

/// What only means something to a mesh that stands in the world.
void checkUntiled(const Scene& scene, const Given& given, const Complain& complain) {
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (scene.meshes[i].tiled) continue;
    for (const char* const key : {"regions", "solid", "colour"}) {
      const auto path = fmt::format("meshes[{}].{}", i, key);
      if (given(path))
        complain(path, fmt::format("{} means nothing to a mesh with tiled: false; expected it without", key));
    }
  }
}

/// What belongs to files, to lines, or to what stands in the way.
void checkLines(const Scene& scene, const Given& given, const Complain& complain) {
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const SceneMesh& mesh = scene.meshes[i];
    const auto says = [&](const char* key) { return given(fmt::format("meshes[{}].{}", i, key)); };
    const auto wrong = [&](const char* key, const std::string& why) {
      complain(fmt::format("meshes[{}].{}", i, key), why);
    };
    if (mesh.lines_m.empty() && mesh.file.empty() && mesh.from.empty())
      complain(
          fmt::format("meshes[{}]", i),
          "a mesh without a file; expected file: MESH.obj, from: SCENE.yaml, or lines: [[[x, y, z], [x, y, "
          "z]], ...]");
    if (mesh.from.empty() && says("product"))
      wrong("product", "product means nothing without from; expected from: SCENE.yaml beside it");
    if (!mesh.from.empty()) {
      for (const char* const key : {"file", "optional"})
        if (says(key)) wrong(key, fmt::format("{} means nothing beside from; expected one of them", key));
    }
    if (!mesh.lines_m.empty()) {
      for (const char* const key : {"file", "from", "regions", "solid", "optional", "unit"})
        if (says(key)) wrong(key, fmt::format("{} means nothing to lines; expected one of them", key));
      if (!mesh.tiled)
        wrong("tiled", "lines with tiled: false are no shape for attractors; expected it without");
    }
    if (!mesh.shade && (mesh.guide || !mesh.tiled || !mesh.lines_m.empty()))
      wrong("shade", "guides, lines and what is not tiled take no light anyway; expected it without");
    if (!mesh.guide) continue;
    if (!mesh.tiled) wrong("guide", "a guide with tiled: false is felt by nobody; expected one of them");
    if (says("solid"))
      wrong("solid", "solid means nothing to a guide, which fills nothing; expected one of them");
  }
}

void checkPlants(const Scene& scene, const Given& given, const Complain& complain) {
  for (std::size_t p = 0; p < scene.plants.size(); ++p) {
    const auto& plant = scene.plants[p];
    const std::string path = fmt::format("plants[{}]", p);
    if (plant.skeleton) {
      if (plant.skeleton->file.empty() && plant.skeleton->from.empty())
        complain(path + ".skeleton", "a skeleton without a file; expected file: FILE, or from: SCENE.yaml");
      if (!plant.skeleton->file.empty() && !plant.skeleton->from.empty())
        complain(path + ".skeleton.from", "file and from; expected one of them");
      for (const char* const key : {"seeds", "scatter", "points", "type"}) {
        if (given(path + "." + key))
          complain(path + "." + key,
                   fmt::format(
                       "{} means nothing to a plant with a skeleton, which starts at its roots; expected one "
                       "of them",
                       key));
      }
      continue;
    }
    if (plant.seeds.empty() && !plant.scatter && plant.table.file.empty()) {
      complain(path,
               "a plant without seeds; expected seeds: [[x, y, z], ...], scatter: {region: name, count: 10}, "
               "points: FILE or skeleton: FILE");
    }
    if (plant.table.file.empty() && given(path + ".type"))
      complain(path + ".type", "type means nothing without points; expected it with a table of points");
  }
}

/// Complains about every name that stood before. `what` is "meshes", "plants" ...
template <class Item>
void checkNames(const std::vector<Item>& items, std::string_view what, const Complain& complain) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].name.empty() || seen.insert(items[i].name).second) continue;
    complain(fmt::format("{}[{}].name", what, i),
             fmt::format("a second one of the {} is called '{}'; expected names that differ (name: ...)",
                         what, items[i].name));
  }
}

void checkCameras(const Scene& scene, const Given&, const Complain& complain) {
  for (const NamedCamera& named : scene.cameras) {
    if (named.camera.eye_m == named.camera.target_m) {
      complain(fmt::format("cameras.{}.target", named.name),
               "the camera looks at the point where it stands; expected target to differ from eye");
    }
  }
}

bool needsCamera(ImageKind kind) {
  return kind != ImageKind::section && kind != ImageKind::attempts && kind != ImageKind::narrow_band &&
         kind != ImageKind::cut_out && kind != ImageKind::sky_tables && kind != ImageKind::contact_sheet;
}

void checkImageCameras(const Scene& scene, const Given&, const Complain& complain) {
  std::vector<std::string> names;
  for (const auto& camera : scene.cameras) names.push_back(camera.name);
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const auto& image = scene.images[i];
    const auto path = fmt::format("images[{}]", i);
    if (image.camera.empty()) {
      if (names.empty() && needsCamera(image.kind)) {
        complain(path, fmt::format("the image {} needs a camera and the scene has none; expected cameras: "
                                   "{{main: {{eye: ..., target: ...}}}}",
                                   image.name));
      }
    } else if (const auto wrong = notCalled("camera", image.camera, names); !wrong.empty()) {
      complain(path + ".camera", wrong);
    }
  }
}

void checkImages(const Scene& scene, const Given& given, const Complain& complain) {
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const auto& image = scene.images[i];
    const auto path = fmt::format("images[{}]", i);
    const auto belongsTo = [&](const std::string& key, std::initializer_list<ImageKind> kinds) {
      if (std::find(kinds.begin(), kinds.end(), image.kind) != kinds.end() || !given(path + "." + key))
        return;
      std::string expected;
      for (const ImageKind kind : kinds)
        expected += (expected.empty() ? "" : " or ") + std::string(nameOf(kind));
      complain(path + "." + key, fmt::format("{} means nothing to kind: {}; expected it with kind: {}", key,
                                             nameOf(image.kind), expected));
    };
    belongsTo("axis", {ImageKind::section, ImageKind::narrow_band});
    belongsTo("at", {ImageKind::section, ImageKind::narrow_band});
    belongsTo("mesh", {ImageKind::narrow_band, ImageKind::cut_out});
    belongsTo("iteration", {ImageKind::points, ImageKind::graph});
    belongsTo("field", {ImageKind::field});
    belongsTo("plant", {ImageKind::threshold, ImageKind::sky_tables});
    belongsTo("show", {ImageKind::vines});
    belongsTo("apart", {ImageKind::vines});
    belongsTo("heights", {ImageKind::vines});
    for (const std::string& part : image.show) {
      if (std::find(kImageParts.begin(), kImageParts.end(), part) == kImageParts.end())
        complain(path + ".show", fmt::format("there is no {} to show; expected some of {}", inQuotes(part),
                                             fmt::join(kImageParts, ", ")));
    }
    if (image.show.empty()) complain(path + ".show", "an image of nothing; expected some of it");
    belongsTo("of", {ImageKind::contact_sheet});
    if (image.kind == ImageKind::contact_sheet && image.of.empty())
      complain(path, "a contact_sheet of no images; expected of: [name, ...]");
  }
}

void checkImageMeshes(const Scene& scene, const Given&, const Complain& complain) {
  std::vector<std::string> names, nowhere;
  for (const auto& mesh : scene.meshes) (mesh.tiled ? names : nowhere).push_back(mesh.name);
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const auto& image = scene.images[i];
    if (image.kind != ImageKind::narrow_band && image.kind != ImageKind::cut_out) continue;
    const auto path = fmt::format("images[{}]", i);
    if (names.empty()) {
      complain(path, fmt::format("a {} of no mesh; expected one that stands in the scene's world",
                                 nameOf(image.kind)));
    } else if (std::find(nowhere.begin(), nowhere.end(), image.mesh) != nowhere.end()) {
      complain(path + ".mesh", fmt::format("the mesh {} stands nowhere (tiled: false); expected one of {}",
                                           inQuotes(image.mesh), listed(names)));
    } else if (const auto wrong = notCalled("mesh", image.mesh, names);
               !image.mesh.empty() && !wrong.empty()) {
      complain(path + ".mesh", wrong);
    }
  }
}

void checkImagePlants(const Scene& scene, const Given&, const Complain& complain) {
  std::vector<std::string> names;
  for (const auto& plant : scene.plants) names.push_back(plant.name);
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const std::string& plant = scene.images[i].plant;
    const ImageKind kind = scene.images[i].kind;
    const bool asks = kind == ImageKind::threshold || kind == ImageKind::sky_tables;
    if (!asks || plant.empty()) continue;
    const std::string wrong = notCalled("plant", plant, names);
    if (!wrong.empty()) complain(fmt::format("images[{}].plant", i), wrong);
  }
}

void checkImageFields(const Scene& scene, const Given&, const Complain& complain) {
  std::vector<std::string> names;
  for (const auto& field : scene.fields) names.push_back(field.name);
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const auto& image = scene.images[i];
    if (image.kind != ImageKind::field) continue;
    if (names.empty()) {
      complain(fmt::format("images[{}]", i), "an image of no field; expected one among the scene's fields");
    } else if (const auto wrong = notCalled("field", image.field, names);
               !image.field.empty() && !wrong.empty()) {
      complain(fmt::format("images[{}].field", i), wrong);
    }
  }
}

void checkSheets(const Scene& scene, const Given&, const Complain& complain) {
  std::vector<std::string> names;
  for (const auto& image : scene.images) {
    if (image.kind != ImageKind::contact_sheet) names.push_back(image.name);
  }
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const auto& of = scene.images[i].of;
    for (std::size_t k = 0; k < of.size(); ++k) {
      const std::string wrong = notCalled("image", of[k], names);
      if (!wrong.empty()) complain(fmt::format("images[{}].of[{}]", i, k), wrong);
    }
  }
}

}  // namespace

const std::vector<Check>& sceneChecks() {
  static const std::vector<Check> checks = {
      check({"world.voxel", "world.resolution"}, checkWorldSize),
      check({"world.bounds", "world.voxel"}, checkBounds),
      check({"world.bounds"}, checkSeeds),
      check({}, checkSeedKeys),
      check({"meshes", "world.bounds"}, checkMeshes),
      check({"sky"}, checkSky),
      check({"sky.background"}, checkBackground),
      check({"sun"}, checkSun),
      check({"meshes"}, checkLines),
      check({}, checkPlants),
      check({"meshes"}, checkUntiled),
      check({"meshes", "attractors"}, checkAttractors),
      check({"attractors", "fields"}, checkFronts),
      check({"meshes", "fields"}, checkFields),
      check({}, [](const Scene& s, const Given&,
                   const Complain& complain) { checkNames(s.meshes, "meshes", complain); }),
      check({}, [](const Scene& s, const Given&,
                   const Complain& complain) { checkNames(s.plants, "plants", complain); }),
      check({"images"}, [](const Scene& s, const Given&,
                           const Complain& complain) { checkNames(s.images, "images", complain); }),
      check({}, checkCameras),
      check({"cameras"}, checkImageCameras),
      check({"images"}, checkImages),
      check({"meshes", "images"}, checkImageMeshes),
      check({"plants", "images"}, checkImagePlants),
      check({"fields", "images"}, checkImageFields),
      check({"meshes", "plants", "pieces", "images"}, checkPieces),
      check({"pieces", "heights", "images"}, checkMadeNames),
      check({"plants", "heights", "world.bounds"}, checkHeights),
      check({"heights", "images"}, checkImageHeights),
      check({"images"}, checkSheets),
      check({"cameras", "images", "film", "iterations"}, checkFilm),
  };
  return checks;
}

}  // namespace espalier::scenes
