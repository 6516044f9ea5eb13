#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "sim/grow/fits.h"
#include "sim/grow/growth.h"
#include "sim/light/brightest.h"
#include "sim/light/light.h"

namespace espalier::sim {

class Claims;
class Nearby;
class PieceGrid;
struct Facets;

struct GrowthProgress {
  int iteration = 0;  ///< that were done
  int iterations = 0;
  int first = 0;  ///< that were done before this run went on
  std::size_t segments = 0, elements = 0;
  std::size_t sites = 0;      ///< that may still grow
  std::size_t proposals = 0;  ///< made since this run began, or went on
};

struct GrowthSettings {
  int iterations = 50;
  std::uint64_t seed = 1;
  LightSource light;
  /// Made once, if a process wants it. By default of an even sky, in cells of 10 degrees.
  std::function<SkyTable()> sky_table = [] { return makeSkyTable(9, 36, backgroundOf(Weighting::uniform)); };
  Commons commons;  ///< what plantings share from the beginning, such as attractors
  bool record_attempts = false;
  std::stop_token stop;
  MemoryPlan memory;
  std::function<void(const GrowthProgress&)> progress;  ///< after each iteration
};

/// What the next step would ask.
struct Due {
  std::vector<std::vector<Site>> sites;  ///< by planting
  std::vector<Columns> memories;         ///< by planting, as they are once sites are due
  Commons commons;                       ///< likewise
};

/// Growth, step by step.
///
/// In each iteration (Greene's term; the design's tick) the world and the plants are frozen; every site that
/// is due proposes in parallel, with random numbers that depend on (seed, planting, plant, node, number,
/// iteration) alone; then the proposals are accepted one by one in the order (planting, plant, node, number),
/// each against what earlier ones placed in the same iteration: segments against each other by voxels, all
/// else exactly (Process::propose). So nothing depends on the number of threads.
///
/// A process that breaks its contract (a voxel outside the world, sites out of order) ends growth with
/// BrokenContract, whatever the build.
class Growing {
 public:
  /// Seeds the plantings. The world is borrowed: it grows with every step. Throws PlantingFaults
  /// (sim/grow/faults.h), and leaves the world as it was, if a seed lies outside the world or inside
  /// something, or two of a name have the same key; and with what the processes say that cannot begin.
  Growing(World& world, std::vector<Planting> plantings, GrowthSettings settings);
  /// Goes on from what was grown before in this world, which holds all of it, by the same plantings. Throws
  /// BrokenContract where it lacks something of the settings' commons.
  Growing(World& world, std::vector<Planting> plantings, GrowthSettings settings, Growth grown);
  ~Growing();
  Growing(const Growing&) = delete;
  Growing& operator=(const Growing&) = delete;

  /// One iteration. False, and nothing happens, when all were done, nothing is left that may grow, or the
  /// next would not fit into memory (Growth::cut_short says so). Throws Stopped when stop is requested; this
  /// must then not be gone on with.
  bool step();
  /// Sites that may still grow.
  std::size_t alive() const;

  const Growth& growth() const { return growth_; }
  Growth take() { return std::move(growth_); }

  /// The sites that the next step asks. Changes nothing.
  Due due() const;
  /// What a site will propose, with all its trials and why each was rejected. Changes nothing. Throws
  /// InputError for a planting that is not there, BrokenContract for a site that is none.
  Proposal propose(const Due& due, std::size_t planting, const Site& site) const;

 private:
  struct Asked;

  void addNode(std::size_t plant, NodeId parent, Vec3 at_vx, std::span<const float> quantities);
  bool nextFits();
  StandView view(std::size_t planting) const;
  std::vector<Site> dueOf(std::size_t planting, Columns& memory, Commons& commons) const;
  Proposal proposeAt(std::size_t planting, const Site& site, const Light* light, const SkyInside* sky,
                     const Columns& memory, const Commons& commons, bool record) const;
  void proposeAll(std::vector<Asked>& asked);
  void acceptAll(std::vector<Asked>& asked);
  bool hindered(const Asked& asked, std::uint32_t before);
  void place(Asked& asked, std::uint32_t before, std::vector<TiledVoxel>& edit);
  void settleAll(std::span<const std::size_t> plantings, const std::vector<Asked>& asked);
  void round(std::span<const std::size_t> plantings, bool later);

  World& world_;
  std::vector<Planting> plantings_;
  GrowthSettings settings_;
  Growth growth_;
  std::vector<Kin> kin_;                 // of each plant
  std::vector<std::uint64_t> streams_;   // of each plant
  std::optional<LightSensor> sensor_;    // if a process wants light
  std::optional<SkySensor> sky_sensor_;  // if a process wants its table
  ClearAhead clear_, sky_clear_;         // theirs
  std::unique_ptr<Claims> claims_;
  std::unique_ptr<PieceGrid> pieces_;
  std::unique_ptr<Nearby> nearby_;  // while pieces are accepted
  std::unique_ptr<Facets> facets_;  // likewise
  Fits fits_;
  int first_ = 0;
  std::size_t segments_ = 0, elements_ = 0, proposals_ = 0;
};

/// All the steps.
Growth grow(World& world, const std::vector<Planting>& plantings, const GrowthSettings& settings);

}  // namespace espalier::sim
