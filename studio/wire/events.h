#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scenes/job/report.h"
#include "scenes/prepare/site.h"
#include "scenes/problem.h"
#include "scenes/scene.h"
#include "sim/grow/grow.h"

/// Events of the stream, as JSON texts (README.md, "Frames").
namespace espalier::studio {

using Version = std::uint32_t;

/// What the page calls a file.
using FileNames = std::function<std::string(const std::string& path)>;

/// How much of a text is looked at.
enum class Depth { text, site };

struct Told {
  std::vector<scenes::Problem> errors, warnings;
};

/// The list of what is wrong, as events and answers have it.
std::string problemsJson(const Told& told, const FileNames& names);

std::string helloEvent(Version version);
std::string problemsEvent(Version version, Depth depth, const Told& told, const FileNames& names);
/// `share`: of the stage that is done, 0..1.
std::string busyEvent(Version version, const std::string& stage, double share);
/// `mesh`: the ID of the site's meshes.
std::string sceneEvent(Version version, const scenes::Scene& scene, const scenes::Site& site,
                       const std::vector<sim::Planting>& plantings, const std::string& mesh);

/// Of growth that goes on: `alive` sites may still grow.
std::string growthEvent(Version version, const sim::Growth& growth, int iterations, std::size_t alive,
                        double seconds);
/// Of growth that is done.
std::string grownEvent(Version version, const scenes::Report::Growth& growth, int iterations,
                       const std::string& ending, double seconds);

/// How often a stage was done, and how long it took, by its name.
struct StageCounts {
  std::map<std::string, std::pair<int, double>> ran;  ///< for the version
  std::map<std::string, int> all;                     ///< since the start
};
std::string stagesEvent(Version version, const StageCounts& counts);

}  // namespace espalier::studio
