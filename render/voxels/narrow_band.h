#pragma once
#include <array>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "render/image/image.h"
#include "sim/base/frame.h"
#include "sim/tile/mesh.h"

namespace espalier::render {

/// A cut at right angles to an axis of a world of voxels, and its picture's axes in the world.
struct CutPlane {
  int axis = 1;            ///< 0..2: x, y, z
  int across = 0, up = 2;  ///< the other two
  int at = 0;              ///< the voxels of the cut, along the axis
};

/// How many voxels to either side of the surface the band reaches.
inline constexpr int kBand = 3;

/// A narrow-band level set of a mesh where a plane cuts it.
struct BandCut {
  glm::ivec2 size{0};              ///< voxels across and up
  std::vector<float> distance_vx;  ///< signed, below 0 inside; rows from below; not a number beyond the band
  /// Where the mesh crosses the plane through the voxels' centres: segments, in voxels (a centre is at whole
  /// numbers).
  std::vector<std::array<glm::vec2, 2>> outline;
  bool has_inside = false;  ///< whether any of the cut lies inside
};

/// The distance from the mesh by OpenVDB (Museth 2013, VDB; the narrow band of Tanaka et al. 2022, figure 3),
/// with the sign that the filling of solids gives, so that the mesh may have holes. Throws InputError as
/// sim::insideOf does.
BandCut bandCut(const sim::Mesh& mesh, const sim::Frame& frame, const CutPlane& plane);
/// What that takes of memory, from above: by the area of the triangles that come near the plane.
double bandBytes(const sim::Mesh& mesh, const sim::Frame& frame, const CutPlane& plane);

struct BandLook {
  int width_px = 960;
  std::string title, note;
};

/// The band's voxels in two hues, for inside and outside, the paler the farther from the surface; the surface
/// as a line; all else paper; below it the legend. Display values.
Image drawNarrowBand(const BandCut& cut, const BandLook& look);

}  // namespace espalier::render
