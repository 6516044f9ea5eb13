#pragma once
// Internal to the wing: closed surfaces as meshes.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/vec.h"
#include "sim/cut/level_set.h"
#include "sim/tile/mesh.h"

namespace espalier::sim {

/// A closed surface of triangles, faces outwards.
struct ClosedPart {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double volume = 0.0;
  Vec3 middle{0.0};  ///< of its volume
};

/// What a surface encloses, by what hangs together: each with the cavities in it. Quads are halved along the
/// shorter diagonal. Largest first, of equal ones by x, y and z of their middles.
std::vector<ClosedPart> partsOf(const QuadSurface& surface);

/// Edges of a mesh with an odd number of triangles, where corners in one place are one; and where one is.
struct OpenEdges {
  std::size_t count = 0;
  Vec3 at_m{0.0};
};
OpenEdges openEdgesOf(const Mesh& mesh);

}  // namespace espalier::sim
