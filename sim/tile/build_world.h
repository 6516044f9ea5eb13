#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/tile/mesh.h"
#include "sim/world/world.h"

namespace espalier::sim {

/// Edges that a voxel may have: OpenVDB takes transforms of 1.4e-5 and less for singular; beyond a thousand
/// kilometres nothing grows.
inline constexpr double kLeastVoxel_m = 2e-5, kMostVoxel_m = 1e6;

/// A straight line to be tiled, as a limb is; a point where both ends are one.
struct Line {
  Vec3 from_m{0.0}, to_m{0.0};
  std::uint32_t region = 0;  ///< of its mesh
};

/// A mesh to be tiled, in place in world space.
struct TiledMesh {
  Mesh mesh;
  bool solid = false;  ///< fill its inside too
  /// Fill it where it is closed, or nearly, if it is not called solid. What it does not enclose stays open.
  bool where_closed = false;
  std::vector<bool> turned = {};  ///< of each triangle: it faces the other way than it is wound; empty: none
  /// In place of the triangles, which then are what the lines look like.
  std::vector<Line> lines = {};
  /// Is felt, as near and as a region, and stands in nobody's way: neither of growth nor of light.
  bool guide = false;
  bool shade = true;  ///< takes light; if not, it goes through, as through glass

  /// Whether light falls on its triangles.
  bool lit() const { return !guide && lines.empty(); }
};

/// What filling found out about a mesh that may leak.
struct FillReport {
  std::string object;
  std::size_t filled = 0;    ///< voxels inside
  std::size_t doubtful = 0;  ///< voxels where the lines along the axes disagreed: there the mesh leaks
  bool found = false;        ///< nobody called it solid; it is closed, at least in part
};

/// Tiles meshes into a new world, in parallel; the result does not depend on the thread count.
/// A voxel that several triangles cross takes the part that covers most of it, the mean colour by area, and
/// the area-weighted normal; meshes that come first keep their voxels. Triangles outside the frame are
/// clipped away. Filling is robust: lines through each free voxel judge it from both of their ends by the
/// winding number of their crossings, so overlapping solids stay full, meshes may be inside out, and where a
/// line leaks its ends contradict each other and the majority of thirteen directions decides
/// (sim/tile/fill.cpp). Throws InputError if the world is too large for memory, naming the voxel size that
/// would fit, for voxels that are too small or too large, and for a mesh that is not sound (indices, numbers)
/// or too large to fill.
World buildWorld(const Frame& frame, const std::vector<TiledMesh>& meshes, int layers,
                 std::vector<FillReport>* fills = nullptr);

/// The smallest frame of whole voxels that holds the meshes plus a margin on every side. Throws InputError
/// where there is nothing to hold or no voxel can have such an edge.
Frame frameAround(const std::vector<TiledMesh>& meshes, double voxel_m, double margin_m);

/// What a world is for, as far as it takes memory.
struct WorldUse {
  int layers = 0;
  double bytes_per_voxel = 0.0;  ///< of fields that cover every voxel; surfaces need none
};

/// Throws InputError when a world of this size would not fit, naming the voxel size that would.
void requireFits(const Frame& frame, const WorldUse& use = {});

}  // namespace espalier::sim
