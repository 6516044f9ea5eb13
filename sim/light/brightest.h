#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/bits.h"
#include "sim/light/background.h"
#include "sim/light/open_rays.h"
#include "sim/sweep/open_table.h"

/// Where light comes from: the way that a plant turns to.
///
/// Its fast estimate is the first moment, Outlook::toward (sim/light/exposure.h), the weighted sum of the
/// open directions. Where no two of them are more than a right angle apart it is the maximum itself; it is
/// off where light comes from opposite sides: it then points between them.
namespace espalier::sim {

/// Greene's latitude-longitude table of the sky (Voxel Space Automata, 1989, section 6): cells of equal steps
/// of elevation and azimuth, the top row first, each with a ray and with the light that it gives where the
/// ray is open.
///
/// A cell's ray runs along the lattice vector nearest to its centre, at most a quarter of a cell's height
/// away from it: so it walks the same voxels as every other ray here, and a sweep casts it for any number of
/// places. Cells that crowd around the zenith share rays.
struct SkyTable {
  struct Cell {
    Vec3f centre{0.0f};     ///< unit direction
    float light = 0.0f;     ///< mean background of its solid angle, times that in steradians
    std::uint32_t ray = 0;  ///< number in `rays`
  };
  int rows = 0, columns = 0;
  DirectionSet rays;  ///< weighted by their cells' light; the weights add up to ExposureField::kWhole
  std::vector<Cell> cells;
};

/// Throws InputError for a table that is too small or too large, and for a background without light.
SkyTable makeSkyTable(int rows, int columns, const Background& background);

/// A table made ready to be filtered.
class SkyFilter {
 public:
  explicit SkyFilter(const SkyTable& table);

  /// The table as Greene filters it: what a surface that faces each cell would receive, the light of the open
  /// cells convolved with the cosine lobe. Bit i of `open` is ray i.
  std::vector<float> illumination(std::span<const std::uint64_t> open) const;

  /// The unit direction in which a surface receives most: the brightest cell of the filtered table, followed
  /// uphill to the maximum beside it, so that it does not jump from cell to cell. Zero where nothing is open.
  Vec3 brightest(std::span<const std::uint64_t> open) const;

 private:
  std::vector<SkyTable::Cell> cells_;
  std::size_t row_;           // floats of a row of lobes_
  std::vector<float> lobes_;  // for each cell what each of all cells receives of it; empty for large tables
};

/// The brightest direction from one voxel of a world.
Vec3 brightest(const SkyTable& table, const BitVolume& occupied, Voxel p);
/// For each of the places of `open`, which must be of the table's rays.
std::vector<Vec3f> brightest(const SkyTable& table, const OpenTable& open);

/// A table of the sky made ready for worlds of one shape; see SkyInside.
class SkySensor {
 public:
  SkySensor(const BitVolume& shape, const SkyTable& table);

 private:
  friend class SkyInside;
  OpenRays rays_;
  SkyFilter filter_;
};

/// Asks for the brightest direction at places of a volume that stands still meanwhile: the same as brightest
/// gives for each. Most of what is asked of a bud's light ends before it comes to this. May be asked from any
/// number of threads. Borrows the first three.
class SkyInside {
 public:
  /// `opaque` must have the shape that was given to the sensor. `ahead` is kept from one to the next of them.
  /// `filled`: as OpenRays has it.
  SkyInside(const SkySensor& sensor, const BitVolume& opaque, ClearAhead& ahead,
            const Bricks* filled = nullptr)
      : filter_(sensor.filter_), rays_(sensor.rays_, opaque, ahead, filled) {}

  /// See SkyFilter::brightest. The place must lie in the volume.
  Vec3 brightest(Voxel place) const { return filter_.brightest(rays_.from(place)); }

 private:
  const SkyFilter& filter_;
  RaysInside rays_;
};

}  // namespace espalier::sim
