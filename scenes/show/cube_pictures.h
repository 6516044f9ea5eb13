#pragma once
#include <glm/vec2.hpp>

#include "render/image/camera.h"
#include "render/image/image.h"
#include "scenes/scene.h"
#include "scenes/show/pictures.h"
#include "sim/base/frame.h"

namespace espalier::scenes {

/// Voxels along a side of the largest world whose voxels are drawn one by one.
inline constexpr int kMostCubes = 64;

/// Throws PlacedError where a scene has an image of kind voxels, and its world more of them than anybody
/// could tell apart.
void requireCubesSeen(const Scene& scene, const sim::Frame& frame);

/// An image of kind voxels: all that is occupied as cubes, with the triangles and lines of meshes, and of
/// plants the segments and elements, in them. Its legend counts the voxels of each object.
render::Image drawCubes(const Finished& finished, const ImageSpec& image, const render::Camera& camera,
                        glm::ivec2 size_px);

}  // namespace espalier::scenes
