#pragma once
#include <cstdint>
#include <optional>

#include "scenes/accuracy/certificate.h"

namespace espalier::scenes {

/// Compares the scene's map of sky_exposure with rays traced on its own triangles (Embree), at points drawn
/// evenly by area, the same for every run: keyed by the seed. None where no point can be lit.
std::optional<Certificate::SpotCheck> spotCheck(const Site& site, std::uint64_t seed);

}  // namespace espalier::scenes
