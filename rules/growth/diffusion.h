#pragma once
#include <memory>

#include "rules/growth/rule_book.h"
#include "sim/grow/process.h"
#include "sim/sense/scene_surface.h"

namespace espalier::rules {

/// As far as a seed may be from the surface on which its plant begins, voxel widths.
inline constexpr double kSeedReach_vx = 16.0;

/// Diffusion as a growth process (Greene 1989, section 7): elements are laid on the scene's surfaces, each
/// beside one that lies there already, at a place that is drawn about it; what crosses nothing and lies near
/// enough to its neighbours and to the surface stays. Each plant begins with an element at the surface that
/// is nearest to its seed. It has no segments.
///
/// Rules are those of the region on which the neighbour lies; an element may come to lie on every region that
/// the top rule set does not forbid. Each round asks all that lies there once, far ones together: so nothing
/// that is laid in one breath can come near another.
std::shared_ptr<const sim::Process> makeDiffusion(RuleBook book,
                                                  std::shared_ptr<const sim::SceneSurface> surface,
                                                  sim::Voxel world_size);

}  // namespace espalier::rules
