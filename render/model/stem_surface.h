#pragma once
#include <vector>

#include "render/model/limbs.h"
#include "render/model/model_mesh.h"

namespace espalier::render {

/// The surface of a plant's limbs: for each that grew from a seed one closed surface with all that stand on
/// it. Every edge lies between two triangles, and all of them face outwards: where a limb leaves another, its
/// tube is stitched into a hole in the other's grid (limb_grid.h). `pieces` are the limbs' numbers.
/// UVs: u around the limb in whole repeats of the bark, each about `bark_m` wide; v along, as far for a
/// repeat as a repeat is wide. `error_m` as for limbsOf.
ModelMesh surfaceOf(const std::vector<Limb>& limbs, double bark_m, double error_m);

}  // namespace espalier::render
