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

/// One mesh of Assimp's scene where one node puts it.
struct MeshInstance {
  glm::dmat4 world_from_mesh{1.0};
  const aiMesh* mesh = nullptr;
  std::string group;  ///< empty where the file gives no name
};

/// The scene's nodes, flattened, in the file's order. Throws sim::InputError above kMostTriangles.
std::vector<MeshInstance> instancesOf(const aiScene& scene);

/// What the base colours in a file are: none to speak of (PLY, STL), display values (OBJ), linear light
/// (glTF).
enum class MeshColours { none, display, linear };

/// The instances' triangles as one mesh, named `stem`, with regions and linear base colours.
sim::Mesh meshOf(const aiScene& scene, const std::vector<MeshInstance>& instances, RegionsFrom regions_from,
                 const std::string& stem, MeshColours colours);

}  // namespace espalier::scenes
