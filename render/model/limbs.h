#pragma once
#include <vector>

#include "render/model/limb.h"
#include "render/model/stem_curves.h"
#include "sim/base/frame.h"
#include "sim/grow/plant.h"

namespace espalier::render {

/// A node's value.
template <class T>
T at(const std::vector<T>& data, sim::NodeId n) {
  return data[static_cast<std::size_t>(n)];
}

/// What of a plant's nodes becomes part of its surface.
struct LimbData {
  const sim::Skeleton& skeleton;
  const std::vector<float>& radii_vx;  ///< as from stemRadii
  std::vector<float> exposures;        ///< of each node
  std::vector<float> youths;           ///< likewise
};

/// One limb for each stem. A ring of n sides is drawn a little outside of its circle, so that it is as wide
/// on the mean over all views as the circle is.
/// A stem whose fork lies inside a limb farther down stands on that one; a stem that never leaves its host
/// becomes a bud on it.
/// `error_m`: how far surfaces may be from what they stand for, by too few sides or stations.
std::vector<Limb> limbsOf(const StemCurves& curves, const LimbData& data, const sim::Frame& frame,
                          double error_m);

}  // namespace espalier::render
