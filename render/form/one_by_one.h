#pragma once
#include "render/form/formed.h"
#include "sim/grow/plant.h"

namespace espalier::render {

/// A plant from each of whose nodes, seeds aside, two others grow at most: where more did, the thickest and
/// the next still do, and the others leave the limb that the thickest begins, one after the other, with room
/// between them as far as it has some. Those that would enter what is blocked stay.
sim::Plant leavingOneByOne(const sim::Plant& plant, const KeptFree& blocked);

}  // namespace espalier::render
