#pragma once
// Internal to the wing.
#include "render/files/gltf_instances.h"
#include "render/files/gltf_surfaces.h"
#include "render/files/surfaces.h"
#include "render/model/plant_model.h"

namespace espalier::render {

/// The plants of a file.
class GltfPlants {
 public:
  GltfPlants(GlbFile& file, GltfMaterials& materials)
      : file_(file), materials_(materials), instances_(file, materials) {}

  /// Adds a plant: a node with one below it for its stems, its stalks and each of its elements that has
  /// triangles, or for the instances of these.
  void add(const PlantModel& plant);

 private:
  /// Compressed where `packed_m` is not 0, as for so thin a radius.
  int surfaceNode(const ModelMesh& mesh, const std::string& material, PlantSurface kind, double packed_m,
                  std::int32_t last_birth);

  GlbFile& file_;
  GltfMaterials& materials_;
  GltfInstances instances_;
};

}  // namespace espalier::render
