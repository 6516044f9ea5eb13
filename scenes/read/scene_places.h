#pragma once
// Internal to the wing.
#include "scenes/scene.h"
#include "scenes/yaml/yaml_tree.h"

namespace espalier::scenes {

/// Notes where a scene's file has what may turn out to be wrong when its site is made.
void notePlaces(Scene& scene, const YamlNode& root);

}  // namespace espalier::scenes
