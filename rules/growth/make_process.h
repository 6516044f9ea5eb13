#pragma once
#include <memory>

#include "rules/language/rule_set.h"
#include "sim/grow/process.h"
#include "sim/sense/scene_surface.h"

namespace espalier::rules {

/// A rule set as a growth process: in each iteration a due bud tries the rule set that holds where it is,
/// then those that stand by for it (`otherwise`), each with its own senses, regions and light, and grows by
/// the first that succeeds; where that one would rather rest, it rests. `propagate` picks how a set grows. A
/// branch leaves a node once the node's branch age is reached.
///
/// Where Greene's text leaves it open: a bud at exposure e grows in an iteration with probability
/// vigour(e) / boost, so that buds in full light grow in every iteration and dim ones `boost` times more
/// rarely; segments keep their length. A bud for which every set has failed retires, as around it the world
/// only gets fuller; a seed tries again, unless it was too dark or too bright for every set.
///
/// The plant's one stem looks as the top rule set says.
///
/// `voxel_m` turns lengths given in metres into voxel widths. Throws sim::InputError for a rule set that
/// cannot work with such voxels, wherever the book leads to it (rules/growth/voxel_widths.h).
std::shared_ptr<const sim::Process> makeProcess(std::shared_ptr<const RuleSet> rules, double voxel_m);
/// The same for a world; throws too where an element has no room in it. Diffusion wants the surfaces of the
/// scene, and throws without them; nobody else does.
std::shared_ptr<const sim::Process> makeProcess(std::shared_ptr<const RuleSet> rules, const sim::Frame& frame,
                                                std::shared_ptr<const sim::SceneSurface> surface = nullptr);

}  // namespace espalier::rules
