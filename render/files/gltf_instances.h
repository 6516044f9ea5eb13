#pragma once
// Internal to the wing.
#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "render/files/gltf_materials.h"
#include "render/model/instances.h"

namespace espalier::render {

/// Instances of shapes by EXT_mesh_gpu_instancing, which the file then cannot be read without; a mesh for
/// each shape, however many plants have it.
class GltfInstances {
 public:
  GltfInstances(GlbFile& file, GltfMaterials& materials) : file_(file), materials_(materials) {}

  /// Adds a node for them. `kind`: the name that plants share; `last_birth`: PlantModel's.
  int node(const Instances& instances, const std::string& kind, std::int32_t last_birth);

 private:
  GlbFile& file_;
  GltfMaterials& materials_;
  std::map<std::tuple<std::uint64_t, std::string, int>, int> shapes_;  // by places, name and material
};

}  // namespace espalier::render
