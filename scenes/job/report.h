#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenes/accuracy/certificate.h"
#include "scenes/lighting.h"
#include "scenes/prepare/job.h"
#include "sim/grow/grow.h"

namespace espalier::scenes {

/// What a run says of itself: report.json. All but `run` is the same for the same scene, rules and seed.
struct Report {
  std::string scene;
  std::vector<std::string> warnings;  ///< "path:line:column: text", the path from the scene's file
  sim::Frame frame;
  std::size_t occupied_voxels = 0;  ///< with the plants
  std::size_t scene_voxels = 0;     ///< before they grew
  std::size_t degenerate_triangles = 0;
  std::vector<sim::FillReport> fills;
  LightAbout light;

  struct Growth {
    int iterations = 0;
    std::vector<std::pair<std::string, std::array<std::size_t, 2>>> plants;  ///< name, segments and elements
    sim::OutcomeCounts buds{}, trials{};
    std::uint64_t state_hash = 0;
  };
  std::optional<Growth> growth;  ///< where plants grew

  /// Surface voxels whose exposure was found, and those that have no place in front (Lighting::gaps).
  struct Exposure {
    std::size_t surfaces = 0, gaps = 0;
    std::size_t in_space = 0;  ///< free voxels whose exposure was found
  };
  std::optional<Exposure> exposure;  ///< where it was what the run was for
  std::optional<Certificate> certificate;

  std::vector<std::string> files;  ///< that were written, in the output folder

  struct Run {
    std::vector<std::pair<std::string, double>> stages_s;
    double total_s = 0.0;
    std::uint64_t peak_memory_bytes = 0;
    int threads = 1;
  } run;
};

/// JSON, two spaces deep, keys in the order above.
std::string toJson(const Report& report);

/// Fills in what there is to say of a world before anything grows in it.
void describeWorld(Report& report, const Job& job);

/// The most memory that this process has held so far.
std::uint64_t peakMemoryBytes();

}  // namespace espalier::scenes
