#pragma once
#include <optional>
#include <vector>

#include "rules/growth/laid_room.h"
#include "rules/growth/senses.h"
#include "sim/grow/process.h"

namespace espalier::rules {

/// The element that a site lays by one rule set, if it finds a place: its shapes are tried one after another,
/// by chance and the more often first the greater their share, each up to Element::trials times.
/// `first_shape` is the plant's number of the set's first one. What becomes of trials is counted in the
/// proposal, and recorded if the view says so.
std::optional<sim::ProposedElement> layElement(const sim::SiteView& view, const LayingSite& site,
                                               const RuleSet& rules, const Surroundings& around,
                                               const Senses& senses, std::int32_t first_shape,
                                               const sim::RandomKey& key, sim::Proposal& proposal);

}  // namespace espalier::rules
