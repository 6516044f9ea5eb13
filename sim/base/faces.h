#pragma once
#include <array>
#include <cstdint>

#include "sim/base/vec.h"

namespace espalier::sim {

/// Faces of a voxel's cube.
inline constexpr std::uint8_t kFaces = 6;
/// Their outward normals: -x, +x, -y, +y, -z, +z; then that of what is no face.
inline constexpr std::array<Voxel, kFaces + 1> kFaceNormals = {
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}, {0, 0, 0}}};

/// The axis that a face looks along.
inline int faceAxis(std::uint8_t face) {
  return face / 2;
}

}  // namespace espalier::sim
