#pragma once
#include <string>

#include "scenes/prepare/site.h"
#include "scenes/scene.h"

/// What follows from which words of a scene and its rules: as long as such a text is the same, so is what
/// was made.
namespace espalier::studio {

/// Of the world with the meshes in it, and of all files but texts: these by their size and time.
std::string tilingText(const scenes::Scene& scene);
/// Of the sky and the sun.
std::string lightText(const scenes::Scene& scene);
/// Of what grows on a site that is as these say.
std::string growthText(const scenes::Scene& scene, const scenes::Site& site);
/// Of how it looks besides.
std::string looksText(const scenes::Scene& scene);

}  // namespace espalier::studio
