#pragma once
#include <cstdint>
#include <optional>

#include "scenes/accuracy/certificate.h"
#include "sim/light/lighting.h"

namespace espalier::scenes {

/// Compares the scene's map of sky_exposure, of its lattice sky, with rays traced on its own triangles
/// (Embree), at points drawn evenly by area, the same for every run: keyed by the seed. None where no point
/// can be lit.
std::optional<Certificate::SpotCheck> spotCheck(const Site& site, const sim::Lighting& light,
                                                std::uint64_t seed);

}  // namespace espalier::scenes
