#pragma once
// Internal to the wing.
#include "scenes/made/heights.h"

namespace espalier::scenes {

/// Which cover lies on a place: the last whose conditions all hold; -1 for none. `on_line`: within the rim of
/// a line.
int coverAt(const std::vector<CoverSpec>& cover, double height_m, double slope_deg, bool on_line);
/// The colour there, edges soft. `line_share`: how much of the place is within a line's rim, 0..1.
sim::Colour coverColour(const std::vector<CoverSpec>& cover, double height_m, double slope_deg,
                        double line_share);

/// Makes the meshes of a relief, a square of four samples as two triangles, and their texture.
void addMeshes(MadeHeights& made, const HeightsSpec& spec);

}  // namespace espalier::scenes
