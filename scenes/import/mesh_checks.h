#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>

namespace espalier::scenes {

/// What a mesh file says of itself, to be held against what Assimp read from it: it passes over cut files and
/// over triangles with wrong indices without a word.
struct DeclaredCounts {
  std::optional<std::uint64_t> vertices;
  std::optional<std::uint64_t> faces;
};

/// Reads the header of a PLY file, on whose damage (a missing `end_header`, a misspelt word) Assimp 5.2.5
/// loops for ever, and holds the counts in it against the file's size. Throws sim::InputError, without the
/// file's name.
DeclaredCounts checkPly(const std::filesystem::path& file);

/// Reads the JSON of a .gltf or .glb file: the length in a GLB header against the file's, and how many
/// triangles the nodes of its default scene give. Throws sim::InputError, without the file's name.
DeclaredCounts checkGltf(const std::filesystem::path& file);

}  // namespace espalier::scenes
