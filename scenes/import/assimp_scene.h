#pragma once
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "sim/tile/mesh.h"

struct aiMesh;
struct aiScene;

namespace espalier::scenes {

/// The most triangles that a mesh may have, instances counted each time.
constexpr std::size_t kMostTriangles = 8'000'000;

/// A mesh of Assimp's scene, or some of its faces, where one node puts it.
struct MeshInstance {
  glm::dmat4 world_from_mesh{1.0};
  const aiMesh* mesh = nullptr;
  unsigned first_face = 0, end_face = 0;
  unsigned first_vertex = 0, end_vertex = 0;  ///< that the faces ask for
  std::string group;                          ///< empty where the file gives no name
  std::size_t material = 0;                   ///< its number among the file's
};

/// The scene's nodes, flattened, in the file's order. Throws sim::InputError above kMostTriangles.
std::vector<MeshInstance> instancesOf(const aiScene& scene);

/// The scene's materials; those without a name get `stem`. With `colours`, as of a glTF file, what they say
/// of their base colours, which is linear light.
std::vector<sim::Material> materialsOf(const aiScene& scene, const std::string& stem, bool colours);

/// The instances' triangles as one mesh, named `stem`, with regions.
sim::Mesh meshOf(const std::vector<MeshInstance>& instances, const std::vector<sim::Material>& materials,
                 RegionsFrom regions_from, const std::string& stem);

}  // namespace espalier::scenes
