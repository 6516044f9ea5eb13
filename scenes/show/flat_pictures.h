#pragma once
#include <vector>

#include "render/image/image.h"
#include "scenes/scene.h"
#include "sim/grow/grow.h"
#include "sim/tile/build_world.h"
#include "sim/world/world.h"

/// Pictures that need no camera; display values.
namespace espalier::scenes {

/// A cut through the world with its boundary layers. Throws sim::InputError where it misses the world, and,
/// as all here, where the world is so narrow that the picture would take more memory than is free for it.
render::Image drawSection(const sim::World& world, const ImageSpec& image);

/// A cut through the narrow-band level set of one of the meshes, on the world's voxels. Throws
/// sim::InputError too where the level set would take more memory than is free for it.
render::Image drawNarrowBand(const std::vector<sim::TiledMesh>& meshes, const sim::Frame& frame,
                             const ImageSpec& image);

/// Greene's figure 2: looks along the axis on which the world is flat; a world that is not flat is seen along
/// z.
render::Image drawAttempts(const sim::World& world, const std::vector<sim::Attempt>& attempts,
                           const ImageSpec& image);

}  // namespace espalier::scenes
