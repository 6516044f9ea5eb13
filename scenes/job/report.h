#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rules/front/front.h"
#include "rules/growth/laid_measure.h"
#include "scenes/accuracy/certificate.h"
#include "scenes/foretell/foretell.h"
#include "scenes/job/seed_failure.h"
#include "scenes/prepare/site.h"
#include "scenes/write/output_folder.h"
#include "sim/base/provenance.h"
#include "sim/grow/grow.h"
#include "sim/light/lighting.h"

namespace espalier::scenes {

/// What a run says of itself: report.json. All but `run` is the same for the same scene, rules and seed.
struct Report {
  std::string scene;
  sim::Provenance made_by;
  std::vector<std::string> warnings;  ///< "path:line:column: text", the path from the scene's file
  sim::Frame frame;
  std::size_t occupied_voxels = 0;  ///< with the plants
  std::size_t scene_voxels = 0;     ///< before they grew
  std::size_t degenerate_triangles = 0;
  std::size_t scene_triangles = 0;  ///< of the meshes that models show
  std::vector<FacingReport> facings;
  std::vector<sim::FillReport> fills;
  sim::LightAbout light;

  struct Growth {
    struct Plant {
      std::string name, planting;
      std::string rules;   ///< the name of its rule set
      bool given = false;  ///< its skeleton was, by the scene
      sim::Vec3 at_m{0.0};
      std::string
          key;  ///< of its seed: the name that it was given, or else the number, as sim::hexOf writes it
      std::size_t segments = 0, elements = 0;
      std::optional<std::size_t> loops;          ///< that its limbs close, where they meet each other
      std::optional<std::size_t> meeting_limbs;  ///< render::PlantModel's, once it was modelled
      std::optional<std::size_t> triangles;      ///< of its model, likewise
      sim::Tally tally;
      std::optional<SeedFailure> failure;
    };
    /// A guide field, as the world's .vdb has it.
    struct Field {
      std::string grid;  ///< its name
      std::size_t voxels = 0;
    };
    int iterations = 0;
    std::vector<Plant> plants;
    sim::OutcomeCounts buds{}, trials{};
    struct Attractors {
      std::string name;
      rules::Fates fates;
      std::string ending;  ///< why those that grew to them ended, in words
    };
    std::vector<Attractors> attractors;  ///< the scene's, by their names
    /// Of a planting that grows by diffusion.
    struct Laid {
      std::string planting;
      std::size_t elements = 0;
      double asked_fill = 1.0;
      rules::LaidMeasure measure;
      std::size_t waiting = 0;    ///< sites that could still lay something
      sim::OutcomeCounts ends{};  ///< what became of its sites
    };
    std::vector<Laid> laid;
    std::uint64_t state_hash = 0;
    std::string cut_short;                     ///< sim::Growth::cut_short; among the warnings too
    std::vector<std::string> in_the_way = {};  ///< of given skeletons that walls meet, likewise
    std::vector<Field> fields = {};
  };
  std::optional<Growth> growth;  ///< where plants grew

  /// Of a mesh that was cut along what grew.
  struct Pieces {
    struct Piece {
      std::string name;
      std::size_t triangles = 0;
      double volume_m3 = 0.0;
      sim::Vec3 middle_m{0.0};
    };
    std::string name, of;
    double kerf_m = 0.0, voxel_m = 0.0;
    std::size_t voxels = 0;  ///< of the solid
    double solid_m3 = 0.0;
    std::size_t crumbs = 0;
    double crumbs_m3 = 0.0;
    std::vector<Piece> pieces;
  };
  std::vector<Pieces> pieces;

  /// Surface voxels whose exposure was found, and those that have no place in front (Lighting::gaps).
  struct Exposure {
    std::size_t surfaces = 0, gaps = 0;
    std::size_t in_space = 0;  ///< free voxels whose exposure was found
  };
  std::optional<Exposure> exposure;  ///< where it was what the run was for
  struct Film {
    std::size_t frames = 0;
    double seconds = 0.0;  ///< that it lasts
    bool video = false;    ///< there is a film.mp4
  };
  std::optional<Film> film;  ///< where one was drawn
  std::optional<Certificate> certificate;

  std::vector<std::filesystem::path> read_paths;  ///< where lies what it was made from; not told

  std::vector<std::string> files;  ///< that were written, in the output folder

  struct Run {
    std::string scene;  ///< its path, as it was given
    std::vector<std::pair<std::string, double>> stages_s;
    double total_s = 0.0;
    std::uint64_t peak_memory_bytes = 0;
    int threads = 1;
    std::optional<int> went_on_from;   ///< the iteration of the saved state
    std::size_t proposals = 0;         ///< that sites made in this run
    std::optional<Foretold> foretold;  ///< where somebody was told
  } run;
};

/// JSON, two spaces deep, keys in the order above.
std::string toJson(const Report& report);

/// The report's file in the output folder.
inline constexpr const char* kReportFile = "report.json";

/// Fills in what there is to say of a world before anything grows in it, and what it was made from.
void describeWorld(Report& report, const Scene& scene, const Site& site);

/// Completes the report of a run that wrote these files.
void finishReport(const std::vector<OutputFile>& files, Report& report);

/// The same, and writes it as report.json, the last of them. Throws sim::InputError.
void writeReport(const OutputFolder& output, const std::vector<OutputFile>& files, Report& report);

/// The end of a summary: how long the run took, and where its files lie.
std::string endOfSummary(const Report& report, const std::filesystem::path& folder);

}  // namespace espalier::scenes
