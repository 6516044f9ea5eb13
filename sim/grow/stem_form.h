#pragma once

namespace espalier::sim {

/// What becomes of a plant's stems once it has grown: how they are shown, lit and written. Growth does not
/// look at it.
struct StemForm {
  enum class Forks {
    grown,  ///< as they grew
    murray  ///< two daughters of a stem leave it at the angles that Murray's law gives their radii
  };
  Forks forks = Forks::grown;

  bool any() const { return forks != Forks::grown; }
};

}  // namespace espalier::sim
