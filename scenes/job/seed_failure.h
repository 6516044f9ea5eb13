#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rules/growth/senses.h"
#include "rules/language/rule_set.h"
#include "sim/grow/grow.h"

/// Why a seed did not grow: the facts. seed_failure_words.h puts them into words.
namespace espalier::scenes {

/// What every seed sees before anything grows, planting by planting. `world` holds the scene alone.
std::vector<rules::Exposure> lightOfSeeds(const std::vector<sim::Planting>& plantings,
                                          const sim::World& world, const sim::LightSource& light);

/// A length that a rule asks for, and how it was written.
struct RuleLength {
  double vx = 0.0;
  bool metres = false;
};

/// A seed that never grew a segment, and what there was about it.
struct SeedFailure {
  /// A rule set that was tried, in the order of trying.
  struct Set {
    std::string path;  ///< from the planting's own set: "", "regions.brick", "otherwise"
    /// Before anything grew: too_dark, too_bright, or no_trial where the light is right.
    sim::Outcome outcome = sim::Outcome::no_trial;
    double exposure = 0.0;  ///< as the set blends it
    double exposure_min = 0.0, exposure_max = 1.0;
    double pace = 1.0;  ///< chance that it does not rest in an iteration
    RuleLength proximity_min, proximity_max;
  };

  /// forbidden, too_dark, too_bright, resting or claimed; or what most trials came to: blocked, too_far,
  /// too_near, out_of_world.
  sim::Outcome reason = sim::Outcome::blocked;
  sim::Tally tally;
  std::vector<Set> sets;          ///< empty where growth is forbidden
  std::string region;             ///< the nearest one; empty beyond the boundary layers
  std::string forbidden_by;       ///< the key that forbids it: "regions.paving"
  std::optional<double> wall_vx;  ///< from the seed's voxel to the nearest one of the scene, by their centres
  int rim_vx = 0;                 ///< voxels between the seed's and the world's rim
  int taken = 0;  ///< of the 26 voxels around the seed's, in the end: occupied, or no part of the world
  double voxel_m = 1.0;
  bool lays = false;  ///< it would have laid an element on a surface
};

/// How far a wall is looked for, voxel widths.
inline constexpr int kFarthestWall = 256;

/// Of a planting's plants, nothing for each that grew or was never asked. `grown` is the world in the end,
/// `scene` what was occupied before.
std::vector<std::optional<SeedFailure>> seedFailures(const std::shared_ptr<const rules::RuleSet>& rules,
                                                     const sim::World& grown, const sim::BitVolume& scene,
                                                     std::span<const sim::Plant> plants,
                                                     std::span<const sim::Tally> tallies,
                                                     std::span<const rules::Exposure> lights);

}  // namespace espalier::scenes
