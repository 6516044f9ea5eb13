#pragma once
#include <cstddef>
#include <vector>

#include "render/model/limb.h"

namespace espalier::render {

/// How many pairs of limbs run into each other other than where one leaves the other, limbs that come back
/// into themselves among them: by their lines and radii, without a mesh.
std::size_t meetingLimbs(const std::vector<Limb>& limbs);

}  // namespace espalier::render
