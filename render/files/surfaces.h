#pragma once
// Internal to the wing.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "render/model/plant_model.h"
#include "sim/tile/mesh.h"

namespace espalier::render {

/// The triangles of a scene mesh that have one material, with the vertices that they use.
struct MaterialSurface {
  std::size_t material = 0;  ///< its number in the mesh
  std::vector<sim::Vec3f> positions_m;
  std::vector<glm::vec2> uvs;       ///< of each vertex, or empty
  std::vector<sim::Vec3f> normals;  ///< likewise: empty where one of them has none
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// By materials, those that are in use alone. Throws InputError when an index is out of range.
std::vector<MaterialSurface> surfacesOf(const sim::Mesh& mesh);

enum class PlantSurface { stems, stalks, blades };

/// What plants share their materials by: the mesh's name without the plant's.
std::string kindOf(const PlantModel& plant, const ModelMesh& mesh);

/// The meshes of a plant that have triangles, and their kinds.
void forEachSurface(
    const PlantModel& plant,
    const std::function<void(const ModelMesh& mesh, const std::string& kind, PlantSurface surface)>& visit);

}  // namespace espalier::render
