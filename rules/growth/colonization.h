#pragma once
#include <memory>

#include "rules/growth/rule_book.h"
#include "sim/grow/process.h"

namespace espalier::rules {

/// Space colonization as a growth process: the front (rules/front/front.h) in a world, among walls and in the
/// light. The attractors are the commons' of that name; all plantings that name the same compete for them.
///
/// What the front pulls, a rule set's biases bend, and `require` judges; a way in which something stands is
/// tried again farther and farther aside, up to `avoid`. A plant is no obstacle to itself. A node that goes
/// straight for its nearest attractor, because it stalled, is not bent. One that finds no way even so lets go
/// of its attractors: they wait for the next node that comes within reach. One on whose way aside nothing
/// came nearer hands them over to the node that it sent there, which goes on along what stands in the way.
std::shared_ptr<const sim::Process> makeColonization(RuleBook book);

}  // namespace espalier::rules
