#pragma once
#include <vector>

#include "rules/front/guide.h"
#include "rules/growth/front_memory.h"
#include "rules/growth/rule_book.h"

/// What bends the ways of a front before the world is asked: guide fields, and the angles at which limbs may
/// leave each other.
namespace espalier::rules {

/// What the fields of a planting follow from.
struct Guidance {
  std::vector<Guide> guides;
  std::vector<double> farthest_vx;  ///< of each plant: from its start to the farthest attractor of it
  const std::vector<sim::Vec3>* normals = nullptr;  ///< of the attractors, as they were given; may be empty
};

/// How far the farthest of the attractors is that have each start as their nearest.
std::vector<double> farthestOf(const Attractors& attractors, const std::vector<sim::Vec3>& starts);

/// Sends an errand a way.
void aim(Errand& errand, const Front& front, const Way& way, const OrderRules& rules);

/// Turns errands, and where they end. Those of nodes that go straight for an attractor follow fields only
/// where they come nearer to it even so; where ways end on attractors, what is turned decides on which.
/// Parallel inside.
void bend(std::vector<Errand>& errands, const Front& front, const sim::StandView& stand, const RuleBook& book,
          const OrderRules& rules, const Guidance& guidance);

/// Whether a node may send out another limb, as far as the rules of its own order say where limbs branch.
bool mayBranch(const sim::StandView& stand, const RuleBook& book, const FrontNode& node, std::int32_t order);

/// The unit vector in the plane of both that is nearest to `way` and whose angle to `heading` lies between
/// two angles, in degrees; both are unit vectors.
sim::Vec3 withinAngles(sim::Vec3 way, sim::Vec3 heading, double least_deg, double most_deg);

}  // namespace espalier::rules
