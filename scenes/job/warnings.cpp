#include "scenes/job/warnings.h"

#include "sim/base/error.h"

namespace espalier::scenes {

void warn(const std::vector<Problem>& warnings, const std::filesystem::path& scene_file,
          const RunOptions& options, Report& report) {
  if (options.strict && !warnings.empty()) throw PlacedError(warnings);
  const auto folder = std::filesystem::absolute(scene_file).lexically_normal().parent_path();
  for (Problem warning : warnings) {
    if (options.on_warning) options.on_warning(warning);
    const auto path = std::filesystem::absolute(warning.path).lexically_normal();
    warning.path = path.lexically_proximate(folder).generic_string();
    report.warnings.push_back(format(warning));
  }
}

ReadTextures texturesFor(bool vines, const Scene& scene, const std::vector<sim::TiledMesh>& meshes,
                         const RunOptions& options, Report& report) {
  if (!vines) return {};
  ReadTextures textures = readTextures(scene, meshes);
  for (const Problem& unread : textures.unread) {
    if (options.on_warning) options.on_warning(unread);
    report.warnings.push_back(unread.text);
  }
  return textures;
}

void requireNone(const std::vector<std::string>& late_warnings, const std::filesystem::path& scene_file,
                 const RunOptions& options) {
  if (options.strict && !late_warnings.empty())
    throw sim::InputError(scene_file.string() + ": " + late_warnings.front());
}

}  // namespace espalier::scenes
