#pragma once
#include <optional>

namespace espalier::sim {

/// How the ways of a plant's stems are made over once it has grown. Growth does not look at it.
struct StemForm {
  /// Ways stray by fractional Brownian motion: over a stretch of any length by
  /// amplitude_vx (length / over_vx)^hurst along each axis, in the mean of squares.
  struct Rough {
    double hurst = 0.7;  ///< between 0, jagged, and 1, smooth; both excluded
    double amplitude_vx = 0.0;
    double over_vx = 1.0;    ///< > 0
    double detail_vx = 0.5;  ///< length of its straight pieces; > 0
  };
  std::optional<Rough> rough;
};

}  // namespace espalier::sim
