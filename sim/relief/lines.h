#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

/// Trees in plan whose lines carry heights.
namespace espalier::sim {

/// Trees in plan: a line from each node to its parent, whose number is always lower.
struct PlanLines {
  std::vector<glm::dvec2> at_m;      ///< x and z
  std::vector<std::int32_t> parent;  ///< -1 for a root
};

/// How many tips each node's line drains; 1 for a tip, and for a root without lines.
std::vector<double> flowOf(const PlanLines& lines);

/// Of each node's line: 0 for what goes on from a root with the most flow at each fork (of equals the lower
/// number), one more for each line that leaves another one's.
std::vector<std::int32_t> ordersOf(const PlanLines& lines);

/// How lines rise from their roots: by grade x flow^-concavity x order_share^order for each metre (Flint
/// 1974, "Stream gradient as a function of order, magnitude, and discharge"; concavity about 0.5).
struct RiseLaw {
  double base_m = 0.0;       ///< of roots
  double grade = 0.3;        ///< metres a metre, of a line that drains one tip; at least 0
  double concavity = 0.5;    ///< 0: all lines are as steep; at least 0
  double order_share = 1.0;  ///< more than 0
};

/// The height of each node.
std::vector<double> heightsOf(const PlanLines& lines, const RiseLaw& law);

/// How wide a line is that drains so much: width x flow^0.5 (hydraulic geometry: Leopold and Maddock 1953).
double widthOf(double width_m, double flow);

}  // namespace espalier::sim
