#pragma once
#include <cstddef>
#include <memory>
#include <span>

#include "rules/growth/laid_kinds.h"
#include "sim/grow/plant.h"
#include "sim/sense/scene_surface.h"
#include "sim/world/world.h"

namespace espalier::rules {

/// The spaces between things that lie flat beside each other: from points all along their rims straight out
/// to the next one, as far as it lies within three times the gap that was asked.
struct Joints {
  double asked_vx = 0.0;  ///< diffusion.gap.min
  double mean_vx = 0.0, deviation_vx = 0.0;
  double length_vx = 0.0;  ///< of the rims along which there are any
  double rims_vx = 0.0;    ///< of all rims
};

/// How far diffusion has filled what it may fill.
struct LaidMeasure {
  double surface_vx2 = 0.0;  ///< that bears something, lies open and can be reached from what lies there
  double covered_vx2 = 0.0;  ///< what of it lies below an outline, each place once
  Joints joints;             ///< length 0 where nothing lies flat, or no gap was asked
};

/// Of all plants of a planting whose rule set, in voxel widths or not, propagates by diffusion. Areas are
/// summed over points (rules/growth/surface_points.h), some million at most.
LaidMeasure measureLaid(const std::shared_ptr<const RuleSet>& rules, std::span<const sim::Plant> plants,
                        const std::shared_ptr<const sim::SceneSurface>& surface, const sim::World& world);

}  // namespace espalier::rules
