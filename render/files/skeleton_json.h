#pragma once
#include <iosfwd>
#include <span>

#include "sim/base/frame.h"
#include "sim/base/provenance.h"
#include "sim/grow/plant.h"

namespace espalier::render {

/// The plants' skeletons as JSON, UTF-8, in metres, y up: "espalier": "skeleton/1", by what it was made, and
/// of each plant its name and columns, one entry a node: `parent` (-1 of the root), `position_m`, `radius_m`
/// (of the segment that ends there, as models have it: stemRadii), `born` and all that the skeleton keeps by
/// name, under `columns`. Every number reads back as it was, and has the fewest digits that do. Keeps little
/// of it in memory. Throws InputError as stemRadii does, std::ios_base::failure where the stream fails.
void writeSkeletons(std::ostream& file, std::span<const sim::Plant> plants, const sim::Frame& frame,
                    const sim::Provenance& made_by = {});

}  // namespace espalier::render
