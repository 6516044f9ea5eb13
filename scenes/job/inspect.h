#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/foretell/foretell.h"
#include "scenes/inspect/inspected.h"

namespace espalier::scenes {

/// What `espalier expose` would take in voxels of this size, or why there could be no such world.
struct VoxelChoice {
  double voxel_m = 0.0;
  std::optional<Foretold> foretold;
  std::string refused;
};

/// From the origin.
inline constexpr double kFarthest_m = 1e6;

/// A scene that would use these meshes, at voxels that give its longest side about 200, and what voxels twice
/// as wide, so wide and half as wide would take. Throws sim::InputError; sim::Stopped.
struct InScene {
  std::vector<VoxelChoice> choices;
  std::string text;  ///< of a scene file
};
InScene sceneWith(std::vector<Inspection> meshes, const std::filesystem::path& scene_file);

/// What a person wants to know of it, in lines.
std::string toText(const Inspected& mesh);
std::string toText(const std::vector<VoxelChoice>& choices);
/// Both as JSON, with the lines of the scene.
std::string toJson(const std::vector<Inspected>& meshes, const InScene& scene);

}  // namespace espalier::scenes
