#pragma once
#include <string>

#include "rules/front/guide.h"
#include "sim/grow/process.h"

namespace espalier::rules {

/// Where the scene's guide field of a name lies among the commons.
std::string fieldNamed(const std::string& name);
/// A guide, its lengths in voxel widths, as columns and back: then it borrows its grid and its region from
/// the columns. Throws BrokenContract for columns that hold none.
sim::Columns columnsOf(const Guide& guide);
Guide guideIn(const sim::Columns& columns);

}  // namespace espalier::rules
