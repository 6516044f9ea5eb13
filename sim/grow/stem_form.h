#pragma once
#include <optional>

namespace espalier::sim {

/// What becomes of a plant's stems once it has grown: how they are shown, lit and written. Growth does not
/// look at it.
struct StemForm {
  enum class Forks {
    grown,  ///< as they grew
    murray  ///< two daughters of a stem leave it at the angles that Murray's law gives their radii
  };
  /// Ways stray by fractional Brownian motion: over a stretch of any length by
  /// amplitude_vx (length / over_vx)^hurst along each axis, in the mean of squares.
  struct Rough {
    double hurst = 0.7;  ///< between 0, jagged, and 1, smooth; both excluded
    double amplitude_vx = 0.0;
    double over_vx = 1.0;    ///< > 0
    double detail_vx = 0.5;  ///< length of its straight pieces; > 0
  };
  Forks forks = Forks::grown;
  std::optional<Rough> rough;  ///< after forks

  bool any() const { return forks != Forks::grown || rough.has_value(); }
};

}  // namespace espalier::sim
