#pragma once
#include <cstdint>
#include <vector>

#include "render/model/limbs.h"
#include "render/model/model_mesh.h"

namespace espalier::render {

/// Two pieces of a surface that cross each other, the lower number first; twice the same: one that crosses
/// itself.
struct Crossing {
  std::uint32_t first = 0, second = 0;
  std::size_t pairs = 0;  ///< of triangles

  friend bool operator==(const Crossing&, const Crossing&) = default;
};

/// All of them, in the order of their numbers: pairs of triangles of which a side of one goes through the
/// other. Triangles that lie in one plane do not cross, nor do those that share a side, and those that share
/// a point only elsewhere.
std::vector<Crossing> selfCrossings(const ModelMesh& mesh);

/// How many pairs of limbs run into each other other than where one leaves the other, limbs that come back
/// into themselves among them: by their lines and radii, without a mesh.
std::size_t meetingLimbs(const std::vector<Limb>& limbs);

}  // namespace espalier::render
