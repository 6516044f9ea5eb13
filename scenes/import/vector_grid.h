#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/provenance.h"
#include "sim/base/vec.h"

namespace espalier::scenes {

/// A vector grid of a .vdb file at the points of a lattice in world space; x fastest, then y, then z.
struct VectorLattice {
  std::string name;  ///< the grid's
  sim::Vec3 low_m{0.0};
  double apart_m = 1.0;
  std::array<std::int32_t, 3> size{0, 0, 0};
  std::vector<sim::Vec3> vectors;
  bool coarser = false;  ///< the grid has more points than kMostLatticePoints
};

/// The most points that a grid is held at.
inline constexpr std::int64_t kMostLatticePoints = 1 << 20;
/// The most along one axis.
inline constexpr std::int32_t kMostLatticeSide = 4096;

/// Reads a grid of vectors (vec3s, vec3d) from an OpenVDB file: the one of that name, or with no name the
/// only one. Its transform must be linear and says where it lies in world metres; vectors are taken as they
/// are written, along the world's axes. Between voxels it is linear, and an inactive voxel is zero. It is
/// sampled over the box of its active voxels and one voxel's width around them, at points as far apart as its
/// voxels are wide at least: of voxels that are cubes along the world's axes these are their centres, with
/// their very values. A grid of more than kMostLatticePoints is sampled farther apart.
///
/// The file is read in a child process, as meshes are (scenes/import/guarded_file.h): OpenVDB 10 can be made
/// to write over its own memory. Throws sim::InputError that begins with the file's path: missing, no regular
/// file, above 256 MB, damaged or cut, without vector grids, without one of that name, with several and no
/// name given, a grid that is empty, bent, in voxel space, beyond 1e6 m, or with a number beyond 1e6.
VectorLattice readVectorGrid(const std::filesystem::path& file, const std::string& grid,
                             sim::InputFile& read);

/// The work of the child.
std::string packedLattice(const std::filesystem::path& file, const std::string& grid);
/// What the reading child sent, unpacked and checked; the bytes are not trusted. Throws std::runtime_error.
VectorLattice latticeFromChild(std::string_view bytes, sim::InputFile& read);

}  // namespace espalier::scenes
