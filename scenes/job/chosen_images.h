#pragma once
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace espalier::scenes {

/// What a scene's film is called among its images.
inline constexpr const char* kFilmName = "film";

/// Leaves of a scene's images those of these names, and what contact sheets among them show; its film only
/// where "film" is among them. Throws sim::InputError for a name that none has, with those that there are.
void keepImages(Scene& scene, const std::vector<std::string>& names);

}  // namespace espalier::scenes
