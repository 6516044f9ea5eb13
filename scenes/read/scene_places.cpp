#include "scenes/read/scene_places.h"

#include <fmt/format.h>

#include "scenes/read/read_table.h"

namespace espalier::scenes {
namespace {

/// What says how large a world is.
std::string sizeKey(const WorldSpec& world) {
  if (world.voxel_m) return "world.voxel";
  if (world.resolution) return "world.resolution";
  return world.bounds_m ? "world.bounds" : "world";
}

void notePlant(PlantSpec& plant, const YamlNode& root, const std::string& path) {
  const auto at = [&](const std::string& key) { return placeOf({&root}, path + key); };
  plant.rules_place = at(".rules");
  for (std::size_t i = 0; i < plant.seeds.size(); ++i)
    plant.seeds[i].place = at(fmt::format(".seeds[{}]", i));
  if (plant.scatter) plant.scatter->region_place = at(".scatter.region");
  if (plant.skeleton)
    plant.skeleton->place = at(plant.skeleton->file.empty() ? ".skeleton.from" : ".skeleton.file");
}

}  // namespace

void notePlaces(Scene& scene, const YamlNode& root) {
  const auto at = [&](const std::string& path) { return placeOf({&root}, path); };
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    scene.meshes[i].place = at(fmt::format("meshes[{}]", i));
  if (root.entry("world")) scene.world.place = at(sizeKey(scene.world));
  if (root.entry("exposure")) scene.exposure.place = at("exposure.where");
  for (AttractorsSpec& attractors : scene.attractors) {
    attractors.place = at("attractors." + attractors.name);
    if (attractors.picture)
      attractors.picture->place = at("attractors." + attractors.name +
                                     (attractors.picture->file.empty() ? ".picture.from" : ".picture.file"));
  }
  for (FieldSpec& field : scene.fields) {
    field.file_place = at(fmt::format("fields.{}.file", field.name));
    field.within_place = at(fmt::format("fields.{}.within", field.name));
  }
  for (PiecesSpec& pieces : scene.pieces) pieces.place = at("pieces." + pieces.name);
  for (HeightsSpec& heights : scene.heights) {
    heights.place = at("heights." + heights.name);
    heights.plants_place = at(fmt::format("heights.{}.plants", heights.name));
  }
  scene.sky.background.file_place = at("sky.background.file");
  for (std::size_t i = 0; i < scene.plants.size(); ++i)
    notePlant(scene.plants[i], root, fmt::format("plants[{}]", i));
  forEachTable(scene,
               [&](PointTable& table, const std::string& path) { table.place = at(path + ".points"); });
  for (NamedCamera& camera : scene.cameras) camera.eye_place = at(fmt::format("cameras.{}.eye", camera.name));
  scene.images_place = at(root.entry("image") != nullptr ? "image" : "images");
  if (scene.film) scene.film->place = at("film");
}

}  // namespace espalier::scenes
