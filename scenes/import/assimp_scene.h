#pragma once
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <string>
#include <string_view>
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
  /// By the mesh's vertices, in place of Assimp's own; null: those.
  const std::vector<glm::vec2>* uvs = nullptr;
  const std::vector<sim::Vec3f>* normals = nullptr;
};

/// The scene's nodes, flattened, in the file's order. Throws sim::InputError above kMostTriangles.
std::vector<MeshInstance> instancesOf(const aiScene& scene);

/// A name as it is shown; nothing where Assimp made it up.
std::string givenName(std::string_view raw);

/// The instances' triangles as one mesh, named `stem`, with regions, and what UVs and normals there are.
sim::Mesh meshOf(const std::vector<MeshInstance>& instances, const std::vector<sim::Material>& materials,
                 RegionsFrom regions_from, const std::string& stem);

}  // namespace espalier::scenes
