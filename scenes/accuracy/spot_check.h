#pragma once
#include <optional>

#include "scenes/accuracy/certificate.h"

namespace espalier::scenes {

/// Compares the scene's map of sky_exposure with rays traced on its own triangles (Embree), at points drawn
/// evenly by area, the same for every run: keyed by the scene's seed. None where no point can be lit.
std::optional<Certificate::SpotCheck> spotCheck(const Job& job);

}  // namespace espalier::scenes
