#pragma once
#include <cstdint>

#include "sim/relief/lines.h"

namespace espalier::sim {

/// How lines stray from their straight ways in plan: their places are moved, by one field of sparse
/// convolution noise along x and another one along z.
struct Meander {
  double amplitude_m = 0.0;  ///< standard deviation along each axis, of the first octave
  double scale_m = 100.0;    ///< the longest wave
  int octaves = 3;           ///< each of half the scale of the one before it, and a quarter of the amplitude
};

/// The same trees with more nodes on their lines, no farther from each other than the waves want, all moved.
/// What lies together moves together: trees stay trees, and where the amplitude is no more than a thirtieth
/// of the scale no line crosses another that it did not cross. Waves shorter than 2 x `spacing_m` are left
/// out.
PlanLines meandering(const PlanLines& lines, const Meander& meander, double spacing_m, std::uint64_t stream);

/// The bytes that it takes.
double meanderBytes(const PlanLines& lines, const Meander& meander, double spacing_m);

}  // namespace espalier::sim
