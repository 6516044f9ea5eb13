#pragma once
#include <vector>

#include "render/model/limb.h"
#include "render/model/stem_curves.h"
#include "sim/base/frame.h"
#include "sim/grow/plant.h"

namespace espalier::render {

/// Where an element stands on a plant's surface.
struct LeafFoot {
  sim::PlacedElement element;  ///< moved there
  sim::Vec3 stem_vx{0.0};      ///< the middle of the limb that it stands on
  double radius_vx = 0.0;      ///< of that; 0 where there is none
};

/// Finds where elements stand. Growth places them about the straight segments of the skeleton, for how thick
/// these will be is not known then.
class LeafFeet {
 public:
  /// `limbs` of the curves' stems, in the order of these; `blocked`: what no corner is moved into. Borrowed:
  /// all must outlive it.
  LeafFeet(const sim::Plant& plant, const StemCurves& curves, const std::vector<Limb>& limbs,
           const sim::Frame& frame, const Blocked& blocked)
      : plant_(plant), curves_(curves), limbs_(limbs), frame_(frame), blocked_(blocked) {}

  /// Moves an element from its segment to the limb, and out to the bark; not into anything that it was clear
  /// of. One on a segment that does not show, inside of a thicker limb, stands where its own comes out. One
  /// on a seed stays where it is.
  LeafFoot of(const sim::PlacedElement& element) const;

 private:
  bool isInTheWay(const sim::PlacedElement& element) const;

  const sim::Plant& plant_;
  const StemCurves& curves_;
  const std::vector<Limb>& limbs_;
  const sim::Frame& frame_;
  const Blocked& blocked_;
};

}  // namespace espalier::render
