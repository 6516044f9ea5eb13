#pragma once
#include <cstdint>
#include <vector>

#include "sim/light/surface.h"

// Internal to the room: from which free places a surface is judged (sim/light/surface.h).
namespace espalier::sim {

/// Places stand so high above a surface, in voxel widths, times |n.x| + |n.y| + |n.z| of its normal: there
/// the stairs of a slanting surface, whose tips reach up to a half of it, hide almost nothing.
inline constexpr float kClear = 0.4f;

inline constexpr int kWayBits = 5, kWayZero = 1 << (kWayBits - 1);

/// Until all places are known, a tap's place is the way from the surface's voxel to it.
inline Voxel wayOf(const SurfaceSensors::Tap& tap) {
  const auto w = static_cast<int>(tap.place);
  constexpr int kMask = (1 << kWayBits) - 1;
  return Voxel(w & kMask, w >> (2 * kWayBits), (w >> kWayBits) & kMask) - kWayZero;
}

/// Finds places before surfaces, one after the other. Of surfaces that lie alike in their voxels and have
/// nothing near, as most of floors and walls do, the places are alike: those are kept.
class PlacesBefore {
 public:
  /// Leaves out places in `nooks` (sim/light/nooks.h) where there are others; null: there are none. Both
  /// volumes must outlive this.
  PlacesBefore(const BitVolume& opaque, const BitVolume* nooks);

  /// Appends a surface's taps, with weights that add up to 1, and says how many; 0: it has no free place in
  /// front.
  std::uint32_t append(const TiledVoxel& tiled, std::vector<SurfaceSensors::Tap>& taps);
  /// The same, each anew.
  std::uint32_t appendPlainly(const TiledVoxel& tiled, std::vector<SurfaceSensors::Tap>& taps) const;

 private:
  struct Pattern {
    Surface surface;
    bool known = false;  // else it has only been met
    struct Row {
      int y, z;
      std::uint64_t free;  // voxels that must be free, from x - kWayZero on
    };
    std::vector<Row> rows;
    int low_x = 0, high_x = 0;
    std::vector<SurfaceSensors::Tap> taps;
  };

  void learn(Pattern& pattern) const;
  bool holds(const Pattern& pattern, Voxel voxel) const;

  const BitVolume& opaque_;
  const BitVolume* nooks_;
  std::vector<Pattern> patterns_;
};

}  // namespace espalier::sim
