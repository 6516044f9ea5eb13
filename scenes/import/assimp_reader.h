#pragma once
#include <filesystem>
#include <vector>

#include "scenes/import/mesh_checks.h"
#include "scenes/scene.h"
#include "sim/tile/mesh.h"

struct aiScene;

namespace espalier::scenes {

/// Throws sim::InputError, without the file's name, for an ending that is not .obj, .gltf, .glb, .ply or
/// .stl.
void requireMeshFormat(const std::filesystem::path& file);

/// What Assimp read from a file, checked and as one mesh. `declared`: what the file says that it holds.
/// Throws sim::InputError, without the file's name.
sim::Mesh meshFrom(const aiScene& scene, const std::filesystem::path& file, const DeclaredCounts& declared,
                   RegionsFrom regions_from);

/// Reads a mesh file through Assimp, in this process. Only for a child process: Assimp can crash or hang on
/// damaged files; importMesh is the safe way. Degenerate triangles are still there.
/// Throws sim::InputError, without the file's name.
/// `files`: what was read, called by its path from the mesh's folder.
sim::Mesh readWithAssimp(const std::filesystem::path& file, RegionsFrom regions_from,
                         std::vector<sim::InputFile>& files);

}  // namespace espalier::scenes
