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

/// What the base colours in a file are: none to speak of (PLY, STL), display values (OBJ), linear light
/// (glTF).
enum class MeshColours { none, display, linear };

/// The scene's materials, with linear base colours. Those without a name get `stem`.
std::vector<sim::Material> materialsOf(const aiScene& scene, const std::string& stem, MeshColours colours);
/// One of a file with display values that does not say what it looks like: grey.
sim::Material unknownMaterial(const std::string& name);

/// The instances' triangles as one mesh, named `stem`, with regions.
sim::Mesh meshOf(const std::vector<MeshInstance>& instances, const std::vector<sim::Material>& materials,
                 RegionsFrom regions_from, const std::string& stem);

}  // namespace espalier::scenes
