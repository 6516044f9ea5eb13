#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/import/gltf_buffers.h"
#include "scenes/problem.h"
#include "sim/tile/mesh.h"

namespace espalier::scenes::gltf {

/// What is read of a glTF file, and nothing that was not looked at: its scene, nodes, meshes and accessors by
/// Assimp, its materials by ourselves.
struct Checked {
  std::string json;  ///< a .gltf file, whose buffers are files by the names of bufferName()
  Buffers buffers;   ///< those files
  std::vector<sim::Material> materials;  ///< without names where the file gives none
  std::vector<Problem> warnings;         ///< of pictures, normals and UVs that are left out
  std::uint64_t triangles; /**< that the nodes of its scene give; Assimp leaves out some, without a word,
                                that it cannot make sense of */
};

std::string bufferName(std::size_t number);

/// Looks at all numbers in a .gltf or .glb file by which another place in it is found, and takes no room by
/// what they promise. Throws sim::InputError, without the file's name, that names the part: lengths, counts
/// and strides beyond what is there, indices of what is not there, nodes that lie below themselves or 1000
/// deep, types that a mesh cannot be made of, extensions that the file cannot do without and that are not
/// read.
Checked check(std::string_view file, const FileBeside& file_beside);

}  // namespace espalier::scenes::gltf
