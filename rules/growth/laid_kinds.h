#pragma once
#include <vector>

#include "rules/diffusion/ground.h"
#include "rules/diffusion/outline.h"
#include "rules/growth/rule_book.h"
#include "sim/grow/plant.h"

/// What diffusion knows of the elements that it lays, by their shapes.
namespace espalier::rules {

/// A shape of a plant, at scale 1. Of what lies flat (Pose::surface) the outline in its own x and y; of all
/// else its foot, a point.
struct LaidKind {
  const Element* rule = nullptr;
  bool flat = false;
  Outline outline{glm::dvec2(0.0)};
  std::vector<std::size_t> edges;  ///< distinctEdges of it
  double reach = 0.0;              ///< of its farthest corner from its foot
  double off_foot = 0.0;           ///< of its nearest corner from its foot
  double low = 0.0, high = 0.0;    ///< of what lies flat: from the surface
};

/// Of all shapes of a book, in their order.
std::vector<LaidKind> laidKinds(const RuleBook& book);

/// How an element stands on its surface: its foot, and the plane there as far as the element tells.
Stance stanceOf(const sim::PlacedElement& element, Pose pose);

/// Seen from above a stance.
Outline outlineAbout(const Stance& stance, const sim::PlacedElement& element, const LaidKind& kind);

/// The greatest diffusion.bend of a book's rule sets, degrees.
double widestBend(const RuleBook& book);

/// From the foot of what lies there to that of the next, at most: beside something that reaches so far, and
/// of elements that do.
double farthestFoot(const Diffusion& diffusion, double beside_vx, double own_vx);

/// The farthest that any point of a new element may lie from the foot of the one beside it.
double mostReach(const RuleBook& book, const std::vector<LaidKind>& kinds);

}  // namespace espalier::rules
