#pragma once
#include <cstdint>
#include <filesystem>

namespace espalier::scenes {

/// How much a PLY file says that it has, to be held against what Assimp reads from it: it passes over cut
/// files without a word.
struct PlyCounts {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
};

/// Reads the header of a PLY file, on whose damage (a missing `end_header`, a misspelt word) Assimp 5.2.5
/// loops for ever, and holds the counts in it against the file's size. Throws sim::InputError, without the
/// file's name.
PlyCounts checkPly(const std::filesystem::path& file);

}  // namespace espalier::scenes
