#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sim/light/surface.h"
#include "sim/sweep/open_table.h"

// Internal to the room.
namespace espalier::sim {

/// What surfaces see along each direction, one surface after the other: from that of a surface's places which
/// lies nearest to the ray from the surface itself. From any other it would see past the edge of what stands
/// in the way sooner or later than the surface does.
class SeenAlong {
 public:
  /// `places`: all of the sensors' (sim/light/surface.h), of which `open` says which directions are open.
  SeenAlong(const OpenTable& open, const DirectionSet& directions, const std::vector<Voxel>& places);

  /// A bit for each direction that is open, words() of the table; until the next call. Those behind the
  /// surface mean nothing.
  const std::uint64_t* from(const TiledVoxel& tiled, std::span<const SurfaceSensors::Tap> taps);

 private:
  /// Which directions each place stands for; of surfaces that lie alike, with the same places, the same.
  struct Shared {
    Surface surface;
    std::vector<Voxel> ways;
    std::vector<std::uint64_t> masks;  // words() for each way
  };
  void share(Shared& shared) const;

  const OpenTable& open_;
  const std::vector<Voxel>& places_;
  std::vector<Vec3f> units_;
  std::vector<Shared> shared_;
  std::vector<Voxel> ways_;
  std::vector<std::uint64_t> seen_;
};

}  // namespace espalier::sim
