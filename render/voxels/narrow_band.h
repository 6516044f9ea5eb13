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

/// A narrow-band level set of a mesh where a plane cuts it.
struct BandCut {
  glm::ivec2 size{0};              ///< voxels across and up
  std::vector<float> distance_vx;  ///< signed, below 0 inside; rows from below; not a number beyond the band
  /// Where the mesh crosses the plane through the voxels' centres: segments, in voxels (a centre is at whole
  /// numbers).
  std::vector<std::array<glm::vec2, 2>> outline;
  bool has_inside = false;  ///< whether any of the whole level set, not of the cut alone, lies inside
};

/// How many voxels to either side of the surface the band reaches.
inline constexpr int kBand = 3;

/// OpenVDB's level set of the whole mesh on the frame's voxels (Museth 2013, VDB; the narrow band of Tanaka
/// et al. 2022, figure 3). A mesh that is not closed may have no inside.
BandCut bandCut(const sim::Mesh& mesh, const sim::Frame& frame, const CutPlane& plane);
/// What the level set takes of memory, from above.
double bandBytes(const sim::Mesh& mesh, const sim::Frame& frame);

struct BandLook {
  int width_px = 960;
  std::string title, note;
};

/// The band's voxels in two hues, for inside and outside, the paler the farther from the surface; the surface
/// as a line; all else paper. Display values.
Image drawNarrowBand(const BandCut& cut, const BandLook& look);

}  // namespace espalier::render
