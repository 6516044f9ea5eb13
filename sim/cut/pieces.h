#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/base/vec.h"
#include "sim/tile/mesh.h"

namespace espalier::sim {

/// A straight limb along which a solid is cut.
struct CutLine {
  Vec3 from_m{0.0}, to_m{0.0};
};

/// How far cuts stray from where they were asked for: smooth keyed noise, its octaves down to the kerf.
struct CutRoughness {
  double amplitude_m = 0.0;  ///< in the mean of squares, along each axis
  double over_m = 1.0;       ///< length of the longest waves
};

struct CutSettings {
  double kerf_m = 0.02;        ///< width of the gap: what lies within half of it is taken away
  Vec3 sweep_m{0.0};           ///< each limb is swept by this into a sheet; zero: round about the limbs
  double voxel_m = 0.005;      ///< edge of the level set's voxels, at most half of the kerf
  double least_share = 0.001;  ///< smaller pieces, by the solid's volume, are left out
  Colour inside{0.5f};         ///< of faces that the cut laid bare; linear RGB
  std::optional<CutRoughness> rough = std::nullopt;
  std::uint64_t stream = 0;  ///< of that noise (sim/base/random.h)
};

/// A closed mesh, each of its edges between two triangles, faces outwards. Faces of the solid keep its
/// materials, and their UVs; those that were laid bare have the last of its materials.
struct Piece {
  Mesh mesh;
  double volume_m3 = 0.0;
  Vec3 middle_m{0.0};  ///< of its volume
};

struct Pieces {
  std::vector<Piece> pieces;  ///< largest first; of equal ones by their middles' x, y and z
  double solid_m3 = 0.0;      ///< the solid's volume before it was cut
  double crumbs_m3 = 0.0;     ///< of the pieces that were left out
  std::size_t crumbs = 0;
  std::size_t voxels = 0;  ///< whose middles lie in the solid
  Vec3 middle_m{0.0};      ///< of the pieces' volume
};

/// The least kerf that a level set resolves, in voxels.
inline constexpr double kLeastKerf_vx = 2.0;

/// Throws InputError for a mesh that is not closed (an edge with an odd number of triangles), for a kerf of
/// less than kLeastKerf_vx voxels, and for a solid that does not fit into memory, naming the voxel that
/// would.
void requireCuttable(const Mesh& solid, const CutSettings& settings);

/// Cuts a solid along lines, by level sets (OpenVDB): what lies nearer to a line, or to its sheet, than half
/// of the kerf is taken away (the threshold distance of Tanaka et al. 2020, section 3.7.5), and what is left
/// falls into what hangs together. Where a level set's cells would have more than one surface, which meshes
/// could only show by edges of four triangles, voxels of the solid give way. Surfaces are as the level set
/// has them: within half a voxel, edges as round. The same bytes on any number of threads.
///
/// Throws InputError where requireCuttable does, for a mesh without an inside, and where nothing is left of
/// it. Stopped.
Pieces cutSolid(const Mesh& solid, std::span<const CutLine> lines, const CutSettings& settings);

}  // namespace espalier::sim
