#include "rules/growth/trial.h"

#include <algorithm>
#include <iterator>

#include "sim/sense/mass.h"
#include "sim/sense/proximity.h"
#include "sim/tile/tiling.h"

namespace espalier::rules {
namespace {

sim::Vec3 unitOrZero(sim::Vec3 v) {
  const double length = glm::length(v);
  return length > 1e-9 ? v / length : sim::Vec3(0.0);
}

/// Limbs leave one node through the same voxels: those of a sibling right beside the node are no obstacle.
void addSiblings(const sim::GrowthView& view, sim::NodeId node, Senses& senses) {
  std::vector<sim::Voxel> limb;
  for (const sim::NodeId child : view.children[static_cast<std::size_t>(node)]) {
    limb.clear();
    sim::tileSegment(senses.at_vx, view.plant.skeleton.position_vx[static_cast<std::size_t>(child)], limb);
    std::copy_if(limb.begin(), limb.end(), std::back_inserter(senses.attachment),
                 [&](sim::Voxel v) { return sim::besides(v, senses.voxel); });
  }
}

/// Growth rate over that at the least exposure: linear from 1 at the minimum to boost at the maximum.
double vigourAt(const RuleSet& rules, double exposure) {
  const double span = rules.require.exposure_max - rules.require.exposure_min;
  const double above = span > 0.0 ? (exposure - rules.require.exposure_min) / span : 1.0;
  return 1.0 + (rules.light.boost - 1.0) * std::clamp(above, 0.0, 1.0);
}

}  // namespace

double blended(const Light& light, double sun_exposure, double sky_exposure) {
  const double sum = light.sun + light.sky;
  return (light.sun * sun_exposure + light.sky * sky_exposure) / sum;
}

Senses sense(const sim::GrowthView& view, const sim::Bud& bud, const RuleSet& rules) {
  const sim::Skeleton& skeleton = view.plant.skeleton;
  const auto node = static_cast<std::size_t>(bud.node);
  Senses senses;
  senses.at_vx = skeleton.position_vx[node];
  senses.voxel = sim::voxelAt(senses.at_vx);
  if (const sim::NodeId parent = skeleton.parent[node]; parent != sim::kNoNode) {
    const sim::Vec3 from = skeleton.position_vx[static_cast<std::size_t>(parent)];
    senses.heading = unitOrZero(senses.at_vx - from);
    sim::tileSegment(from, senses.at_vx, senses.attachment);
  }
  addSiblings(view, bud.node, senses);
  senses.light = rules.bias.brightest == Brightest::table
                     ? sim::brightest(view.sky_table, view.world.opaque(), senses.voxel)
                     : unitOrZero(view.light.sky.toward);
  senses.sky_exposure = view.light.sky.fraction();
  senses.sun_exposure = view.light.sun.fraction();
  senses.exposure = blended(rules.light, senses.sun_exposure, senses.sky_exposure);
  senses.vigour = vigourAt(rules, senses.exposure);
  senses.away = sim::awayFromScene(view.world, senses.voxel);
  if (highest(rules.bias.twist) != 0.0 || lowest(rules.bias.twist) != 0.0) {
    const auto mass = sim::centreOfMass(view.world.occupied(), senses.voxel, rules.bias.twist_radius_vx);
    if (mass) senses.twist = unitOrZero(glm::cross(senses.heading, *mass - senses.at_vx));
  }
  senses.circumstance = {senses.exposure, static_cast<double>(view.iteration),
                         senses.at_vx.y * view.world.frame().voxel_m};
  return senses;
}

sim::Vec3 flattened(sim::Vec3 direction, sim::Voxel world_size) {
  for (int axis = 0; axis < 3; ++axis) {
    if (world_size[axis] == 1) direction[axis] = 0.0;
  }
  return unitOrZero(direction);
}

}  // namespace espalier::rules
