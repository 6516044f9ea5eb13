#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "sim/grow/rule.h"
#include "sim/light/brightest.h"
#include "sim/light/random_sky.h"
#include "sim/sweep/directions.h"

namespace espalier::sim {

/// Seeds of one kind: each grows into a plant of its own.
struct Planting {
  std::string name;
  const Rule* rule = nullptr;
  std::vector<Vec3> seeds_vx;  ///< inside the world, in free voxels
};

struct GrowthProgress {
  int iteration = 0;  ///< that were done
  int iterations = 0;
  std::size_t segments = 0;
  std::size_t buds = 0;  ///< that may still grow
};

struct GrowthSettings {
  int iterations = 50;
  std::uint64_t seed = 1;
  DirectionSet sky, sun;
  std::optional<RandomSky> random_sky;       ///< Greene's rays, instead of the sky's directions
  Weighting weighting = Weighting::uniform;  ///< of the random rays
  SkyTable sky_table;                        ///< may be empty where no rule looks for the brightest spot
  bool record_attempts = false;
  std::stop_token stop;
  std::function<void(const GrowthProgress&)> progress;  ///< after each iteration
};

struct Growth {
  std::vector<Plant> plants;
  int iterations = 0;      ///< done before the last bud retired
  OutcomeCounts buds{};    ///< by what became of them in an iteration
  OutcomeCounts trials{};  ///< by what became of them
  std::vector<Attempt> attempts;
};

/// Grows plants in a world, which they change: every segment and element that is placed occupies its voxels.
///
/// In each iteration (Greene's term; the design's tick) the world and the plants are frozen; every bud that
/// is due proposes in parallel, with random numbers that depend on (seed, plant, bud, iteration, trial)
/// alone; then the proposals are accepted one by one in the order (plant, node, tip before side), each
/// against the voxels that earlier ones claimed in the same iteration. So nothing depends on the number of
/// threads.
///
/// Throws Stopped when stop is requested; InputError if a seed lies outside the world
/// or inside something.
Growth grow(World& world, const std::vector<Planting>& plantings, const GrowthSettings& settings);

/// A hash (XXH3) of all that growth made: skeletons, elements, occupancy.
std::uint64_t stateHash(const World& world, const std::vector<Plant>& plants);

}  // namespace espalier::sim
