#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::scenes {

/// The tables of docs/accuracy.md that need no scene, as Markdown: the program's maps of shapes whose answer
/// is known, by weighting and voxel size. All sections, or the one with this title.
std::string accuracyStudy(std::string_view only = {});

/// A table of maps against rays traced on meshes' own triangles (Embree), by voxel size; uniform weighting.
/// Meshes are filled. Throws sim::InputError for a mesh that cannot be read.
std::string accuracyOnMeshes(const std::vector<std::filesystem::path>& meshes);

}  // namespace espalier::scenes
