#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/grow/process.h"
#include "sim/world/world.h"

namespace espalier::sim {

/// Where a plant starts, and what its random numbers follow from.
struct Seed {
  Vec3 at_vx{0.0};
  std::uint64_t key = 0;  ///< another one, another plant; two of a planting's name must differ
};

/// Seeds at places in voxel space, keyed by where they stand in the world: in millionths of a metre, so that
/// a plant is the same whatever stands before it in a list. Seeds in one place are told apart by their order.
std::vector<Seed> seedsAt(const Frame& frame, const std::vector<Vec3>& places_vx);
/// The key of a place and of a name. `twin`: how many equal ones came before.
std::uint64_t keyOfPlace(Vec3 place_m, std::uint64_t twin = 0);
std::uint64_t keyOfName(std::string_view name);

/// Seeds of one kind: each grows into a plant of its own, whose random numbers follow from its planting's
/// name and its key.
struct Planting {
  std::string name;
  std::shared_ptr<const Process> process;  ///< never null
  std::vector<Seed> seeds;                 ///< inside the world, in free voxels
  bool anywhere = false;                   ///< seeds may stand inside things too
};

/// Throws BrokenContract where one has no process.
void requireProcesses(const std::vector<Planting>& plantings);

/// What became of a plant's sites and trials.
struct Tally {
  OutcomeCounts sites{}, trials{};
};

/// The plants of one planting, and what its process remembers.
struct Stand {
  std::size_t first = 0, count = 0;  ///< of Growth::plants
  Columns memory;
};

/// All that growth made but the world: a plain value.
struct Growth {
  int iterations = 0;  ///< done, the last of them the one before which the last site retired
  std::vector<Plant> plants;
  std::vector<Tally> tallies;  ///< of each plant
  std::vector<Stand> stands;   ///< of each planting
  Commons commons;
  bool recorded = false;          ///< whether attempts were kept from the beginning
  std::vector<Attempt> attempts;  ///< of all sites, in their order
  std::string cut_short;          ///< why growth ended before its time, in a sentence; no state keeps it
};

/// The sum over all plants.
Tally total(const Growth& growth);

/// A hash (XXH3) of all that growth made: occupancy, what takes light, plants and memories. The same on any
/// machine and any number of threads.
std::uint64_t stateHash(const World& world, const Growth& growth);

}  // namespace espalier::sim
