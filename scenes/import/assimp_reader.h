#pragma once
#include <filesystem>

#include "scenes/import/mesh_import.h"
#include "scenes/scene.h"
#include "sim/tile/mesh.h"

struct aiScene;

namespace espalier::scenes {

/// Throws sim::InputError, without the file's name, for an ending that is not .obj, .gltf, .glb, .ply or
/// .stl.
void requireMeshFormat(const std::filesystem::path& file);

/// What meshOf relies on: meshes, materials and corners that are there, numbers that are
/// finite. Throws sim::InputError, without
/// the file's name.
void requireSound(const aiScene& scene);

/// Reads a mesh file through Assimp, in this process. Only for a child process: Assimp can crash or hang on
/// damaged files; importMesh is the safe way. Degenerate triangles are still there.
/// Throws sim::InputError, without the file's name.
/// `sources`: what it was read from; warnings do not name the file either.
sim::Mesh readWithAssimp(const std::filesystem::path& file, RegionsFrom regions_from, MeshSources& sources);

}  // namespace espalier::scenes
