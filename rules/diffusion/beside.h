#pragma once
#include <span>
#include <vector>

#include "rules/diffusion/outline.h"

/// Laying one outline flush with another, as pavers do: edge to edge, pushed along until it meets something.
namespace espalier::rules {

/// Where an outline lies: turned by an angle's cosine and sine, then moved.
struct Laid {
  glm::dvec2 turn{1.0, 0.0};
  glm::dvec2 by{0.0};
  double contact = 0.0;  ///< share of its rim that runs along others, the gap away
};

/// The edges by which an outline can lie in ways that differ: a square has one, other rectangles have two.
/// Edge i runs from corner i to the next.
std::vector<std::size_t> distinctEdges(const Outline& outline);

/// All places in which an edge of `own`, one of `edges`, lies flush with an edge of `parent`, `gap` away from
/// it and from all `others` (of which the parent is one), and where it cannot be pushed along farther without
/// coming too near to one of them, or two corners meet. At least a third of the shorter edge runs along the
/// other. `askew`: an angle's cosine and sine by which it is turned from there; then its nearest corner is
/// what is the gap away.
std::vector<Laid> placesBeside(const Outline& parent, const Outline& own, std::span<const std::size_t> edges,
                               double gap, std::span<const Outline> others, glm::dvec2 askew = {1.0, 0.0});

}  // namespace espalier::rules
