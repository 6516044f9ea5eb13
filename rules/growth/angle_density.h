#pragma once
#include <array>
#include <vector>

#include "rules/language/rule_set.h"

/// A table of angles (RandomTree::wander_table), ready to be drawn from.
namespace espalier::rules {

/// A density runs straight from point to point, so that within a piece the share of all up to an angle is a
/// parabola, and a draw in [0, 1) leads back to its angle by one square root. Not by steps of a sampled
/// inverse: these are wrong where the density comes from 0 or goes to it, and lay angles into gaps of the
/// table.
struct AngleDensity {
  struct Piece {
    float from = 0.0f;             ///< the least draw that falls into it, or into one behind
    float per_share = 0.0f;        ///< 1 / the share of all that is in it
    float low = 0.0f;              ///< density where it begins, of a mean of 1
    float rise = 0.0f;             ///< density where it ends, less that
    float at = 0.0f, span = 0.0f;  ///< where it begins and how far it goes, as shares of the angle
  };
  std::array<Piece, kMostAngles> pieces;  ///< those in which anything is, in order
  std::size_t count = 0;
};

/// Of a table that passed the checks of rules/language; points beyond kMostAngles are left out.
AngleDensity angleDensityOf(const std::vector<glm::dvec2>& table);

}  // namespace espalier::rules
