#pragma once
// Internal to the wing: all that it wants of OpenVDB, whose headers are heavy.
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/base/bits.h"
#include "sim/base/vec.h"
#include "sim/cut/sheets.h"

namespace espalier::sim {

/// A surface of quads, in voxel widths.
struct QuadSurface {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 4>> quads;  ///< counterclockwise from outside
};

/// What holds matter in a box of voxels, as the distance from its surface near that.
class LevelSet {
 public:
  /// Of a closed mesh of which it is known which voxels' middles are inside. Voxel widths.
  LevelSet(std::span<const Vec3> corners, std::span<const std::array<std::uint32_t, 3>> triangles,
           const BitVolume& inside);
  ~LevelSet();
  LevelSet(const LevelSet&) = delete;
  LevelSet& operator=(const LevelSet&) = delete;

  /// The distance from the mesh's surface, no more than kBand_vx, and the triangle that is nearest there;
  /// below 0: none is near.
  float distanceAt(Vec3 p) const;
  std::int32_t nearestAt(Vec3 p) const;

  /// Takes away what is nearer to sheets than `half_kerf`, measured from where `straying` leads.
  void cut(std::span<const NearSheets> near, std::span<const Sheet> sheets, double half_kerf,
           const std::function<Vec3(Vec3)>& straying);

  /// Its surface, a closed one, of which no edge has more than two quads.
  QuadSurface surface();

  static constexpr double kBand_vx = 3.0;

 private:
  /// Both voxels between which the surface goes through are active, wherever that is.
  void activateCrossings();
  /// No two voxels of matter touch by an edge or a corner alone.
  void separate();

  struct Grids;
  std::unique_ptr<Grids> grids_;
};

}  // namespace espalier::sim
