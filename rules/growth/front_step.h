#pragma once
#include <optional>

#include "rules/growth/front_memory.h"
#include "rules/growth/random_tree.h"

namespace espalier::rules {

/// Where a node of the front goes that was sent on an errand: to its very end where nothing bends it or
/// stands in the way; else by trials, the first straight on, the others farther and farther aside. What it
/// tried is counted in `proposal`. `set` numbers the rule sets that one site tries, from 0.
std::optional<Candidate> frontStep(const sim::SiteView& view, const RuleSet& rules,
                                   const Surroundings& around, const Senses& senses, const Errand& errand,
                                   const sim::RandomKey& key, unsigned set, sim::Proposal& proposal);

}  // namespace espalier::rules
