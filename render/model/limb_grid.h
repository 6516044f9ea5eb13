#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "render/model/limbs.h"

namespace espalier::render {

/// A hole in a limb's grid: the quads of `rows` rows from `row` on and of `columns` columns from `column` on,
/// around the ring. One limb stands in it. Fewer columns than the grid has sides, so that it is a disc.
struct Patch {
  int row = 0, rows = 1, column = 0, columns = 1;
  Foot foot;  ///< where the hole's rim lies: the limb's own foot, as near as there was room
};

/// A corner of a limb's grid that lies on the rim of a patch, and so not in its own place.
struct RimPoint {
  std::uint32_t corner = 0;  ///< ring * sides + column
  double arc_m = 0.0, angle = 0.0;
  sim::Vec3 at_m{0.0};
};

/// The corners of a patch's rim (ring, column), counter-clockwise seen from outside, from the middle of its
/// far side on; and how far around the rim each is, radians.
struct Rim {
  std::vector<std::pair<int, int>> corners;
  std::vector<double> turns;
};

/// A limb's surface between its first ring and its last: `sides` columns by rows of quads between rings, with
/// a patch for each limb that stands on it. A sphere's topology follows from it, whatever the geometry:
/// every patch is a disc, no two share a quad, and each is filled by a disc, the limb that stands there.
struct LimbGrid {
  int sides = 0;
  std::vector<double> arcs_m;  ///< of the rings
  std::vector<Patch> patches;  ///< of each of the limbs that stand here, in their order
  std::vector<Rim> rims;       ///< of each patch
  std::vector<RimPoint> rim;   ///< by their corners
  /// Corners that are no part of the surface, for they are inside of patches or would change nothing: those
  /// beside rims of rings between which the limb is straight.
  std::vector<std::uint32_t> absent;
  std::size_t left_out = 0;  ///< so many of these are not inside of patches

  std::uint32_t corner(int ring, int column) const {
    return static_cast<std::uint32_t>(ring * sides + column % sides);
  }
  /// Points of the surface: corners but those that are absent.
  std::size_t points() const { return arcs_m.size() * static_cast<std::size_t>(sides) - absent.size(); }
  /// The number of a corner's point among them.
  std::uint32_t pointOf(std::uint32_t corner) const;
  /// Of a corner on a rim.
  const RimPoint& rimPoint(std::uint32_t corner) const;
};

/// `standing`: the feet of the limbs that stand on it. Where they would overlap they are made smaller; where
/// the grid is too coarse for them it has more columns than the limb has sides. Those with larger feet are
/// given their place first, and one whose place is taken stands as near as it can.
/// `error_m` as for limbsOf.
LimbGrid gridOf(const Limb& limb, std::span<const Foot> standing, double error_m);

/// A place on a foot's rim: `turn` radians counter-clockwise seen from outside from its far end.
sim::Vec3 onRim(const Limb& host, const Foot& foot, double turn);

}  // namespace espalier::render
