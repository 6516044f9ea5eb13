#pragma once
#include <vector>

#include "sim/grow/plant.h"

namespace espalier::render {

/// The radius of the segment that ends at each node, voxel widths; a seed has that of its thickest segment.
/// By pipes a stem is a bundle of pipes, one to each tip (Shinozaki et al. 1964, with the exponent of Runions
/// et al. 2007): r^exponent is the sum of the children's r^exponent. By age it is thicker by as much in each
/// iteration since its node was placed (Tanaka et al. 2022).
/// Where the skeleton has a column of radii (sim::kRadiusColumn) these are taken, up to the girth's most; of
/// one that is no radius, the twig's. All but those are multiplied by the girth's share for each order of
/// branching: as the process counts it (the column "order"), else a limb goes on in the thickest child, the
/// straightest among equals.
/// Throws InputError unless the exponent is 1 at least, the radii are positive, and the share is above 0.
std::vector<float> stemRadii(const sim::Skeleton& skeleton, const sim::StemGirth& girth);

}  // namespace espalier::render
