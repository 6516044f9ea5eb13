#pragma once
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>

#include "scenes/job/model_files.h"
#include "scenes/job/report.h"
#include "scenes/prepare/site.h"
#include "scenes/problem.h"
#include "scenes/scene.h"

namespace espalier::scenes {

struct RunOptions {
  std::filesystem::path folder{};  ///< made if it is not there
  bool pictures = true;            ///< draw the scene's images
  ModelsWanted models{};           ///< beside plant.glb
  bool strict = false;  ///< warnings are errors; of one that comes after growth once all is written
  std::stop_token stop;
  std::function<void(const Foretold&)> on_foretold;        ///< once, in the first stage that it tells of
  std::function<void(const std::string& stage)> on_stage;  ///< as each begins
  std::function<void(const sim::GrowthProgress&)> on_growth;
  std::function<void(const Problem& warning)> on_warning;  ///< once each, before anything grows
};

/// What a run does with the state of growth, the file growth.state in its folder.
struct Keeping {
  int every = 0;        ///< keep it after every so many iterations; 0: only at the end
  bool resume = false;  ///< go on from the one that the folder has, if it has one
  bool keep = true;     ///< leave the last one there
};

/// The main job: reads a scene's meshes, tiles them, grows its plants, and writes the model (plant.glb), the
/// world (world.vdb), the pictures that the scene asks for and report.json into the folder, every file whole
/// or not at all, the report last. But for states nothing is written before the growth is done. A run that
/// goes on from a state ends with the bytes of one that was never interrupted. Throws sim::InputError;
/// MeshMissing; sim::Stopped when stopped, and then nothing more is written. Growth that does not fit into
/// memory ends early, and what has grown is written, with a sentence in Report::warnings.
Report runScene(const Scene& scene, const RunOptions& options, const Keeping& keeping = {});

/// What that job will take, without doing it: the scene is tiled, and grows for as long as it takes to tell.
/// Throws as runScene does before anything grows, and tells what it warns of, also of what is drawn at the
/// end. `look` sees the site before anything grows, and may find more that is wrong.
Foretold foretellRun(const Scene& scene, const RunOptions& options,
                     const std::function<void(const Site& site)>& look = {});

/// Draws a scene's images of what was grown before, from the state in the folder `from`: with other cameras,
/// suns, skies, sizes and kinds if the scene says so, but on the same meshes in the same world, with the same
/// plants, and with the seed that they grew with. Writes pictures and nothing else. Throws as runScene does,
/// and for a scene without images.
Report renderScene(Scene scene, const std::filesystem::path& from, const RunOptions& options);

/// What a person wants to know of a run: a few lines that end with the files.
std::string summary(const Report& report, const std::filesystem::path& folder);

}  // namespace espalier::scenes
