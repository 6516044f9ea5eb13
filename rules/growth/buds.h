#pragma once
#include <span>
#include <vector>

#include "sim/grow/process.h"

/// What processes that grow from nodes remember: which of them may still grow, and when.
namespace espalier::rules {

/// Every plant's seed may grow at once.
void beginBuds(const sim::StandView& stand, sim::Columns& memory);

/// Those whose time has come, in order.
std::vector<sim::Site> dueBuds(const sim::StandView& stand, const sim::Columns& memory);

/// A site that grew is done and brings its sprouts; one that did not tries again in the next iteration,
/// unless it retires; one whose voxels another took first never retires for that. A plant that is a single
/// segment, no bud of which found a way on, grows another from its seed.
void settleBuds(const sim::StandView& stand, std::span<const sim::Verdict> verdicts, sim::Columns& memory);

std::size_t countBuds(const sim::Columns& memory);

}  // namespace espalier::rules
