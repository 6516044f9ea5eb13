#include "scenes/job/model_files.h"

#include <fmt/format.h>

#include <memory>
#include <ostream>
#include <utility>

#include "render/files/gltf.h"
#include "render/files/obj.h"
#include "scenes/job/plant_models.h"
#include "scenes/product.h"

namespace espalier::scenes {
namespace {

constexpr const char* kObjStem = "plant";

std::string levelFile(int level) {
  return fmt::format("plant_lod{}.glb", level);
}

}  // namespace

std::vector<const sim::Mesh*> meshesOf(const Site& site) {
  std::vector<const sim::Mesh*> meshes;
  for (const auto& tiled : site.meshes) {
    if (!tiled.guide) meshes.push_back(&tiled.mesh);
  }
  return meshes;
}

render::PlantModels modelsFrom(const ModelSources& sources, int level, bool instances) {
  if (level == 0 && !instances && !sources.in_memory.empty()) {
    return [&models = sources.in_memory](const std::function<void(const render::PlantModel&)>& take) {
      for (const auto& model : models) take(model);
    };
  }
  return modelsOf(sources.site.world.frame(), sources.plants, sources.bare, level, instances);
}

std::vector<std::string> modelFileNames(const ModelsWanted& wanted) {
  std::vector<std::string> names{kPlantFile};
  for (int level = 1; level <= wanted.coarser; ++level) names.push_back(levelFile(level));
  if (wanted.obj) {
    for (const char* ending : {".obj", ".mtl"}) names.push_back(std::string(kObjStem) + ending);
  }
  return names;
}

std::vector<OutputFile> modelFiles(const ModelsWanted& wanted, const ModelSources& sources,
                                   std::function<void(std::size_t, const render::PlantModel&)> modelled) {
  std::vector<OutputFile> files;
  const bool instances = wanted.instances;
  files.push_back({kPlantFile, [sources, instances, modelled = std::move(modelled)](std::iostream& out) {
                     const auto heard = [&](const std::function<void(const render::PlantModel&)>& take) {
                       std::size_t number = 0;
                       modelsFrom(sources, 0, instances)([&](const render::PlantModel& model) {
                         modelled(number++, model);
                         take(model);
                       });
                     };
                     render::writeGlb(out, meshesOf(sources.site), heard, sources.made_by);
                   }});
  for (int level = 1; level <= wanted.coarser; ++level) {
    files.push_back({levelFile(level), [sources, level, instances](std::iostream& out) {
                       render::writeGlb(out, meshesOf(sources.site), modelsFrom(sources, level, instances),
                                        sources.made_by);
                     }});
  }
  if (!wanted.obj) return files;
  render::ObjLibrary library =
      render::objLibrary(meshesOf(sources.site), modelsFrom(sources, 0, false), kObjStem, sources.made_by);
  files.push_back({std::string(kObjStem) + ".obj", [sources](std::ostream& out) {
                     render::writeObj(out, meshesOf(sources.site), modelsFrom(sources, 0, false), kObjStem,
                                      sources.made_by);
                   }});
  files.push_back(fileOf(std::string(kObjStem) + ".mtl", std::move(library.mtl)));
  for (render::ObjPicture& picture : library.pictures)
    files.push_back(fileOf(std::move(picture.file), std::move(picture.bytes)));
  return files;
}

}  // namespace espalier::scenes
