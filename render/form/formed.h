#pragma once
#include <functional>
#include <span>
#include <vector>

#include "sim/grow/plant.h"
#include "sim/world/world.h"

/// What has grown, in the form in which it is shown, lit and written (sim::StemForm): other places for its
/// nodes, and more of them. Looks alone: growth goes on from what grew.
namespace espalier::render {

/// Whether stems must not enter a voxel.
using KeptFree = std::function<bool(sim::Voxel)>;

/// A plant in its form. `world`: it as it was before anything grew. Pieces that would enter what is kept
/// free, or leave the world, stay where they grew.
sim::Plant formed(const sim::Plant& plant, const sim::World& world, const KeptFree& kept_free);

/// Plants in their forms, and the world in which they stand so.
struct FormedStand {
  std::vector<sim::Plant> plants;
  sim::World world;
};
/// Of plants that grew in `grown`, which was `before` until they did. None enters the scene, another that
/// grew, or another's form. Throws sim::Stopped.
FormedStand formedStand(sim::World before, const sim::World& grown, std::span<const sim::Plant> plants);

/// Whether any of these has a form of its own.
bool anyForm(std::span<const sim::Plant> plants);

}  // namespace espalier::render
