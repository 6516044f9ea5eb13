#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "sim/tile/build_world.h"

namespace espalier::scenes {

/// What was found out about the sides of a mesh's faces.
struct FacingReport {
  std::string object;
  std::size_t turned = 0;   ///< triangles that face the other way than they are wound
  double area_share = 0.0;  ///< theirs of all, 0..1
};

/// Finds the sides to which triangles face, where nobody vouched for their winding (TiledMesh::where_closed),
/// and sets TiledMesh::turned. Triangles that share an edge face the same side, that of the larger part of
/// them; and what would be dark to that side and has light on the other faces the other: walls of a house
/// that is inside out, ground that is wound downwards. Light comes from above, past all meshes. What has
/// light on both sides, or on none, faces as it is wound. Says so of each mesh in which anything is turned.
std::vector<FacingReport> findFacing(std::vector<sim::TiledMesh>& meshes);

}  // namespace espalier::scenes
