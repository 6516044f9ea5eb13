#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/prepare/site.h"
#include "scenes/scene.h"
#include "sim/grow/grow.h"
#include "sim/grow/state.h"

/// Growth kept in the output folder, and what it was grown from.
namespace espalier::scenes {

/// The file's name in the output folder.
inline constexpr const char* kStateFile = "growth.state";

/// What a scene's growth follows from: its keys but its name, exposure, iterations, images, cameras and the
/// hour of its shadows, and what its meshes and skeletons hold; where there are skeletons also the iterations
/// in which they grow whole.
sim::Inputs inputsOf(const Scene& scene, const Site& site);

/// What must be the same.
enum class Same {
  everything,  ///< for growth to go on
  plants       ///< for the plants to be shown: meshes, world and plants, under whatever light
};

/// A folder's state; nothing if it has none. Throws sim::InputError for one that is damaged or cannot be
/// read.
std::optional<sim::State> readKept(const std::filesystem::path& folder);

/// The seed that a state was grown with: the scene's, or the command line's.
std::optional<std::uint64_t> seedOf(const sim::State& state);

/// Puts the plants of a folder's state into the site: the world is then as it was when the state was kept.
/// Trials come back only where the scene has an image of them. Throws sim::InputError for a state that was
/// grown from something else, with what differs.
sim::Growth takeUp(sim::State state, const std::filesystem::path& folder, const Scene& scene, Site& site,
                   const std::vector<sim::Planting>& plantings, Same same);

/// Growth that goes on from what takeUp gave. Throws sim::InputError for what is whole, and nothing that its
/// processes can go on with.
std::unique_ptr<sim::Growing> goOnFrom(sim::Growth kept, const std::filesystem::path& folder,
                                       sim::World& world, const std::vector<sim::Planting>& plantings,
                                       const sim::GrowthSettings& settings);

/// Removes a folder's state, if it has one. Throws sim::InputError where that cannot be done.
void dropState(const std::filesystem::path& folder);

}  // namespace espalier::scenes
