#pragma once
// Internal to the wing.
#include <cstddef>

namespace espalier::render {

/// The headers of a .glb file, of three words, and of its chunks, of two.
inline constexpr std::size_t kGlbWord = 4, kGlbHeader = 12, kGlbChunkHeader = 8;

}  // namespace espalier::render
