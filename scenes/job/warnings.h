#pragma once
#include <filesystem>
#include <vector>

#include "scenes/job/report.h"
#include "scenes/job/run.h"
#include "scenes/problem.h"

namespace espalier::scenes {

/// Tells of warnings, each once, by RunOptions::on_warning and in the report, where a file's path is from the
/// scene's file, so that it does not depend on where the program was started. With RunOptions::strict they
/// are errors: throws sim::InputError.
void warn(const std::vector<Problem>& warnings, const std::filesystem::path& scene_file,
          const RunOptions& options, Report& report);

}  // namespace espalier::scenes
