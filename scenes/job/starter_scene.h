#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/foretell/foretell.h"
#include "scenes/prepare/site.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// A scene to begin with.
struct StarterScene {
  std::string text;        ///< of its file
  Scene scene;             ///< what that says
  Site site;               ///< of its meshes
  Clock::duration tiling;  ///< what that took
};

/// The scene of some meshes, which were read and `placed` before, that grows a vine of the library from the
/// feet of their walls. `box_m`: around all of them, as placed. Paths are written from where `scene_file`
/// will lie. The meshes are tiled to find places for seeds: in the open, beside something that rises, and the
/// brightest of some; where nothing rises, on top. Throws sim::InputError.
StarterScene starterScene(const std::vector<SceneMesh>& meshes, std::vector<sim::Mesh> placed,
                          const std::array<sim::Vec3, 2>& box_m, double voxel_m,
                          const std::filesystem::path& scene_file);

}  // namespace espalier::scenes
