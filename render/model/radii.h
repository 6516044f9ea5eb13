#pragma once
#include <vector>

#include "sim/grow/plant.h"

namespace espalier::render {

/// Stem thickness by the pipe model: a stem is a bundle of pipes, one to each tip (Shinozaki et al. 1964,
/// with the exponent of Runions et al. 2007): r^exponent is the sum of the children's r^exponent.
struct PipeModel {
  float exponent = 2.05f;        ///< 2: Leonardo's rule, 3: Murray's law
  float tip_radius_vx = 0.075f;  ///< of a stem that does not fork, voxel widths
  float max_radius_vx = 0.8f;    ///< no stem is thicker, voxel widths
};

/// The radius of the segment that ends at each node, voxel widths; a seed has that of its thickest segment.
/// Throws InputError unless the exponent and both radii are positive.
std::vector<float> pipeRadii(const sim::Skeleton& skeleton, const PipeModel& model);

}  // namespace espalier::render
