#pragma once
#include <limits>

namespace espalier::sim {

/// How thick a plant's stems are.
struct StemGirth {
  enum class By {
    pipes,  ///< a stem is a bundle of pipes, one to each tip: r^exponent is the sum of its children's
    age     ///< thicker by as much in each iteration
  };
  By by = By::pipes;
  double twig_vx = 0.08;      ///< radius of a twig that does not fork, or is new
  double exponent = 2.05;     ///< 2: Leonardo's rule, 3: Murray's law
  double thickens_vx = 0.02;  ///< by age: in an iteration
  double most_vx = std::numeric_limits<double>::infinity();  ///< no stem's radius is more
  /// What radii are multiplied by for each order of branching, 0 for limbs of seeds; more than 0, at most 1.
  double order_share = 1.0;
};

}  // namespace espalier::sim
