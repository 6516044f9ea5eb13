#pragma once
#include <filesystem>
#include <vector>

#include "scenes/job/report.h"
#include "scenes/job/run.h"
#include "scenes/prepare/texture_reader.h"
#include "scenes/problem.h"

namespace espalier::scenes {

/// Tells of warnings, each once, by RunOptions::on_warning and in the report, where a file's path is from the
/// scene's file, so that it does not depend on where the program was started. With RunOptions::strict they
/// are errors: throws PlacedError.
void warn(const std::vector<Problem>& warnings, const std::filesystem::path& scene_file,
          const RunOptions& options, Report& report);

/// Textures of meshes, for images of vines: none where no image is one. Tells of those that cannot be read,
/// which are warnings too.
ReadTextures texturesFor(bool vines, const Scene& scene, const std::vector<sim::TiledMesh>& meshes,
                         const RunOptions& options, Report& report);
/// Of what came up after growth, once all is written: throws sim::InputError in a strict run if there is any.
void requireNone(const std::vector<std::string>& late_warnings, const std::filesystem::path& scene_file,
                 const RunOptions& options);

}  // namespace espalier::scenes
