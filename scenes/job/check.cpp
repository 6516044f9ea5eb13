#include "scenes/job/check.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "scenes/job/expose.h"
#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"

namespace espalier::scenes {
namespace {

using Json = nlohmann::ordered_json;

void addOnce(std::vector<Problem>& problems, const Problem& problem) {
  if (std::find(problems.begin(), problems.end(), problem) == problems.end()) problems.push_back(problem);
}

/// Who has plants and names an exposure may want either.
Foretold foretellEither(const Scene& scene, const RunOptions& options) {
  if (scene.plants.empty()) return foretellExpose(scene, options);
  const bool exposes = scene.exposure.place.path != nullptr;
  return foretellRun(scene, options, [&](const Site& site) {
    if (exposes) requireExposable(scene, site, options);
  });
}

void checkSite(const Scene& scene, std::stop_token stop, Checked& checked) {
  RunOptions options;
  options.stop = std::move(stop);
  options.on_warning = [&](const Problem& warning) { addOnce(checked.warnings, warning); };
  try {
    checked.foretold = foretellEither(scene, options);
  } catch (const MeshMissing& missing) {
    addOnce(checked.warnings, missing.problem());
  } catch (const PlacedError& error) {
    checked.errors = error.problems();
  } catch (const sim::InputError& error) {
    checked.errors.push_back({scene.file.string(), 0, 0, error.what()});
  }
}

Checked checkedOf(const Result<RulesOrScene>& read, const std::filesystem::path& file, CheckDepth depth,
                  std::stop_token stop) {
  Checked checked{file, read.problems(), {}, {}};
  if (!read) return checked;
  checked.warnings = read->warnings;
  if (read->scene && depth == CheckDepth::site) checkSite(*read->scene, std::move(stop), checked);
  return checked;
}

Json jsonOf(const Problem& problem, const char* severity) {
  Json json{{"file", problem.path}};
  if (problem.line > 0) {
    json["line"] = problem.line;
    json["column"] = problem.column;
  }
  if (problem.end_column > 0) {
    json["end_line"] = problem.line;
    json["end_column"] = problem.end_column;
  }
  json["severity"] = severity;
  json["message"] = problem.text;
  if (!problem.key.empty()) json["key"] = problem.key;
  return json;
}

}  // namespace

Checked checkFile(const std::filesystem::path& file, CheckDepth depth, std::stop_token stop) {
  return checkedOf(readRulesOrScene(file), file, depth, std::move(stop));
}

Checked checkText(std::string text, const std::filesystem::path& file, CheckDepth depth,
                  std::stop_token stop) {
  return checkedOf(readRulesOrSceneText(std::move(text), file), file, depth, std::move(stop));
}

std::string toJson(const std::vector<Checked>& files) {
  Json json{{"problems", Json::array()}, {"foretold", Json::array()}};
  for (const Checked& checked : files) {
    for (const Problem& problem : checked.errors) json["problems"].push_back(jsonOf(problem, "error"));
    for (const Problem& warning : checked.warnings) json["problems"].push_back(jsonOf(warning, "warning"));
    if (!checked.foretold) continue;
    const Foretold& foretold = *checked.foretold;
    json["foretold"].push_back(
        {{"file", checked.file.string()},
         {"size", {foretold.frame.size.x, foretold.frame.size.y, foretold.frame.size.z}},
         {"voxel_m", foretold.frame.voxel_m},
         {"seconds", foretold.seconds},
         {"bytes", foretold.bytes}});
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace espalier::scenes
