#pragma once
#include <functional>
#include <optional>

#include "rules/growth/random_tree.h"
#include "rules/growth/rule_book.h"

/// How a site grows by a rule book: the part that all processes of the rule language share.
namespace espalier::rules {

/// Where one rule set leads a site, if anywhere: `set` numbers those that one site tries, from 0. What it
/// tried is counted in the proposal.
using Step =
    std::function<std::optional<Candidate>(const RuleSet& rules, const Surroundings& around,
                                           const Senses& senses, unsigned set, sim::Proposal& proposal)>;

/// Whether a site grows by one rule set: then the proposal holds what it would place.
using Try = std::function<bool(const RuleSet& rules, const Surroundings& around, const Senses& senses,
                               unsigned set, sim::Proposal& proposal)>;

/// The site tries rule sets from the first on, null for none, each with its own senses and light, and those
/// that stand by for it; the first that succeeds ends it, and one that would rather rest.
sim::Proposal proposeBySets(const sim::SiteView& view, const sim::Site& site, const sim::RandomKey& key,
                            const RuleBook& book, const RuleSet* first, const Try& attempt);

/// The site tries the rule set that holds where it is, then those that stand by for it, each with its own
/// senses, regions and light, and grows by the first that succeeds; where that one would rather rest, it
/// rests. The segment carries elements, and the
/// quantities of seedlingOf's columns.
/// `order`: of the segment that would grow; where the book tells orders apart it is a quantity too. `joins`:
/// the node that it meets, if it meets one, likewise.
sim::Proposal proposeByBook(const sim::SiteView& view, const sim::Site& site, const sim::RandomKey& key,
                            const RuleBook& book, int order, const Step& step,
                            sim::NodeId joins = sim::kNoNode);

/// A new node's quantities, one for each column of seedlingOf, in the order of their names. `exposure`: as
/// its rule set blends what was `seen`; `radius_vx`: of plants that have that column too. The node stands at
/// `to_vx`, at the end of a segment from the site.
std::vector<float> quantitiesOf(const sim::SiteView& view, const RuleBook& book, const sim::Site& site,
                                sim::Vec3 to_vx, const Exposure& seen, double exposure, int order,
                                double proximity_vx, std::optional<float> radius_vx = std::nullopt,
                                sim::NodeId joins = sim::kNoNode);

/// What a site sees; all there is where its plant's process wants no light.
Exposure seenAt(const sim::SiteView& view);

/// The order of a node, if its plant tells orders apart; else 0.
int orderOf(const sim::Plant& plant, sim::NodeId node);

/// A plant without nodes, and what must be sensed for it.
sim::Plant seedlingOf(const RuleBook& book);
sim::Wants wantsOf(const RuleBook& book);

}  // namespace espalier::rules
