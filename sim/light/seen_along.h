#pragma once
#include <cstdint>
#include <vector>

#include "sim/sweep/directions.h"
#include "sim/sweep/open_table.h"
#include "sim/world/world.h"

// Internal to the room.
namespace espalier::sim {

/// What surfaces along the axes see along each direction. From the place right before it a floor would see
/// past a wall's edge as far too soon as that place stands above it; so it looks along each direction from
/// where the ray from the surface itself comes through the layer of places before it, and not through what
/// stands there.
class SeenAlong {
 public:
  /// The table must be of all places before surfaces (sim/light/surface.h).
  SeenAlong(const OpenTable& open, const DirectionSet& directions);

  /// A bit for each direction that is open, words() of the table; until the next call. Those behind the
  /// surface mean nothing. Null where the surface slants or has no place right before it.
  const std::uint64_t* from(const TiledVoxel& tiled);

 private:
  /// Of surfaces that lie alike.
  struct Rays {
    Surface surface;
    Voxel before{0};                   // the place right before the voxel
    std::vector<Voxel> aside;          // ways on from there to where rays come through
    std::vector<std::uint64_t> masks;  // the directions of each: words()
  };
  void find(Rays& rays) const;

  const OpenTable& open_;
  std::vector<Vec3f> units_;
  std::vector<Rays> rays_;
  NearbyNumbers numbers_;
  std::vector<std::uint64_t> seen_;
};

}  // namespace espalier::sim
