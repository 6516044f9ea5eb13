#pragma once
#include <optional>
#include <string>

#include "scenes/job/report.h"
#include "scenes/job/run.h"
#include "scenes/prepare/site.h"
#include "scenes/scene.h"

namespace espalier::scenes {

struct ExposeResult {
  Report report;
  std::string table;  ///< the regions' exposure, as a text to read
};

/// Exposure maps of a scene's world, in which nothing grows: panels for each camera (or one that looks from
/// the sunny side, where the scene has none), exposure.vdb, exposure.csv, exposure.json and report.json,
/// written into the folder as runScene writes. Scene::exposure says where light is wanted beside the
/// surfaces. Throws sim::InputError; MeshMissing; sim::Stopped when stopped, and then nothing more is
/// written.
ExposeResult exposeScene(const Scene& scene, const RunOptions& options);

/// What that job will take, without doing it: the scene is tiled. Throws as exposeScene does before it looks
/// for light.
Foretold foretellExpose(const Scene& scene, const RunOptions& options);

/// The same of a scene whose site is made, which took so much time.
Foretold foretellExpose(const Scene& scene, const RunOptions& options, const Site& site,
                        Clock::duration making);

/// Throws PlacedError as exposeScene would before it looks for light, of a scene whose site is made.
void requireExposable(const Scene& scene, const Site& site, const RunOptions& options);

/// What a person would paste into a report: the world, what the numbers are, the regions, the files.
std::string summary(const ExposeResult& result, const std::filesystem::path& folder);

}  // namespace espalier::scenes
