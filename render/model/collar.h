#pragma once
#include "render/model/limb.h"

namespace espalier::render {

/// The surface between the rim on which a limb stands and its first ring: it comes to the ring along the
/// limb, and leaves the host's surface the more along it the wider the rim is than the ring.
class Collar {
 public:
  /// Borrows them all.
  Collar(const Limb& host, const Foot& foot, const Section& ring);

  /// `turn`: radians around, counter-clockwise seen from outside from the foot's far end; `share`: 0 at the
  /// rim .. 1 at the ring.
  sim::Vec3 at(double turn, double share) const;

 private:
  const Limb& host_;
  const Foot& foot_;
  const Section& ring_;
  sim::Vec3 middle_;  // of the foot
};

}  // namespace espalier::render
