#include "scenes/job/warnings.h"

#include "sim/base/error.h"

namespace espalier::scenes {

void warn(const std::vector<Problem>& warnings, const std::filesystem::path& scene_file,
          const RunOptions& options, Report& report) {
  if (options.strict && !warnings.empty()) throw ManyLines(warnings);
  const auto folder = std::filesystem::absolute(scene_file).lexically_normal().parent_path();
  for (Problem warning : warnings) {
    if (options.on_warning) options.on_warning(formatWarning(warning));
    const auto path = std::filesystem::absolute(warning.path).lexically_normal();
    warning.path = path.lexically_proximate(folder).generic_string();
    report.warnings.push_back(format(warning));
  }
}

}  // namespace espalier::scenes
