#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "render/model/model_mesh.h"
#include "sim/base/frame.h"
#include "sim/tile/mesh.h"

/// Polygons cut to the grid of voxels, each fragment in one colour (Greene 1989, section 4, figures 5 and
/// 9A): a world of voxels as other renderers can show it.
namespace espalier::render {

/// Triangles to be cut, and the world to whose voxels.
struct Uncut {
  std::string name;
  std::vector<sim::Vec3> corners_vx;  ///< all finite
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Of a mesh; corners that lie within a hundred-thousandth of a voxel width of a plane between voxels, as far
/// as single precision tells, are taken to lie in it: what was drawn there is cut to no slivers. Throws
/// InputError when an index is out of range.
Uncut uncut(const sim::Mesh& mesh, const sim::Frame& frame);
Uncut uncut(const ModelMesh& mesh, const sim::Frame& frame);

struct DicedMesh {
  std::string name;
  std::vector<sim::Vec3f> positions_m;
  std::vector<sim::Colour> colours;  ///< of each position: that of the voxel of all fragments that meet there
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< wound as the mesh's
  std::size_t fragments = 0;

  bool empty() const { return triangles.empty(); }
};

/// The colour of fragments in a voxel of the world; asked by several threads at once.
using ColourOfVoxel = std::function<sim::Colour(sim::Voxel)>;

/// How many fragments that makes. Keeps none.
std::size_t fragmentsOf(const Uncut& mesh, sim::Voxel size);

/// At most, while meshes of so many fragments are made and written.
double dicedBytes(std::size_t fragments);

/// Cuts it. Fragments are as sim/tile/dice.h has them, as triangles. One vertex stands for all in the same
/// place with the same colour; triangles of which nothing is left in single precision are left out. The same
/// on any number of threads.
DicedMesh diced(const Uncut& mesh, const sim::Frame& frame, const ColourOfVoxel& colour);

}  // namespace espalier::render
