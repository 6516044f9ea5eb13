#pragma once
#include "render/image/image.h"
#include "scenes/scene.h"
#include "sim/grow/growth.h"
#include "sim/light/brightest.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// What the tips of one limb saw of the sky, laid out as Greene's figure 7 (Voxel Space Automata, 1989): for
/// each of its nodes, a row a node from the seed on, the table of open directions when the next segment grew
/// (A), times the background (B, with a cross at the brightest spot), and B filtered with the cosine lobe;
/// below, the background. The limb is the plant's longest by segments; of more than six nodes six are shown.
/// Display values. `bare`: what the scene alone occupies. Throws sim::InputError where the plant has no
/// segment.
render::Image drawSkyTables(const sim::World& world, const sim::BitVolume& bare, const sim::Growth& growth,
                            const sim::SkyTable& table, const ImageSpec& image);

}  // namespace espalier::scenes
