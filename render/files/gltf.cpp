#include "render/files/gltf.h"

#include <sstream>

#include "render/files/gltf_plant.h"
#include "render/files/gltf_scene_mesh.h"
#include "sim/base/stop.h"

namespace espalier::render {

void writeGlb(std::iostream& file, const std::vector<const sim::Mesh*>& meshes, const PlantModels& plants,
              const sim::Provenance& made_by) {
  writeGlbFile(file, made_by, [&](GlbFile& writer) {
    GltfMaterials materials(writer);
    GltfPlants grown(writer, materials);
    for (const sim::Mesh* mesh : meshes) {
      sim::throwIfStopped();
      addSceneMesh(writer, materials, *mesh);
    }
    plants([&](const PlantModel& plant) {
      sim::throwIfStopped();
      grown.add(plant);
    });
  });
}

std::string glbBytes(const ModelScene& scene, const sim::Provenance& made_by) {
  std::stringstream out(std::ios::in | std::ios::out | std::ios::binary);
  const auto plants = [&](const std::function<void(const PlantModel&)>& take) {
    for (const PlantModel* plant : scene.plants) take(*plant);
  };
  writeGlb(out, scene.meshes, plants, made_by);
  return std::move(out).str();
}

}  // namespace espalier::render
