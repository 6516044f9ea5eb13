#pragma once
#include "sim/base/bits.h"
#include "sim/base/bricks.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// Whether the scene stands between a place and the eye. A place in one of its surfaces is seen from before
/// that surface.
class Sight {
 public:
  /// Borrows all; `bare` is what the scene alone occupies.
  Sight(const sim::World& world, const sim::BitVolume& bare, const sim::Bricks& bricks, sim::Vec3 eye_m);

  bool hides(sim::Vec3 at_m) const;

 private:
  const sim::World& world_;
  const sim::BitVolume& bare_;
  const sim::Bricks& bricks_;
  sim::Vec3 eye_vx_;
};

}  // namespace espalier::scenes
