#pragma once
#include <vector>

#include "scenes/problem.h"
#include "scenes/scene.h"
#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// Whether a scene's world could be made.
enum class WorldMade { yes, no };

/// Hints for a scene whose meshes look as if their files counted another unit than metres, with the places of
/// the meshes. `meshes`: of each of the scene's, in order, as placed.
///
/// Too large: a mesh that names no `unit`, is 200 m long or more, and would be 1 to 100 m in centimetres or
/// millimetres. Towns and terrain are as long, so that where the world can be made all the same only what is
/// 200 m high too, and with walls, is told of. Too small: where the scene names its voxels, all meshes
/// together that are less than 0.3 m and than 16 voxels. Who says `unit: m` has said that it is right.
std::vector<Problem> unitHints(const Scene& scene, const std::vector<const sim::Mesh*>& meshes,
                               WorldMade made);

}  // namespace espalier::scenes
