#pragma once
#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scenes/foretell/costs.h"
#include "scenes/prepare/site.h"
#include "scenes/show/pictures.h"
#include "sim/grow/growth.h"
#include "sim/grow/process.h"
#include "sim/world/ray.h"

namespace espalier::scenes {

/// What a job will take, told while most of it is still to come: for whoever decides whether to wait.
struct Foretold {
  sim::Frame frame;
  double seconds = 0.0;                                  ///< of all of it
  double bytes = 0.0;                                    ///< that it will hold at most
  std::vector<std::pair<std::string, double>> stages_s;  ///< of those to come, growth among them
};

/// "165 x 150 x 195 voxels of 0.04 m; about 5 s and 680 MB of memory".
std::string toText(const Foretold& foretold);

using Clock = std::chrono::steady_clock;

/// What has grown, or will have.
struct Grown {
  double segments = 0.0, elements = 0.0;
};
Grown grownIn(std::span<const sim::Plant> plants);

/// Of a job that lets a scene's plants grow: watches them until it can tell. Borrows all but the pictures.
class GrowthForeteller {
 public:
  /// Growth is about to begin, or to go on, in a job that began at `began`. `pictures`: those that will be
  /// drawn.
  GrowthForeteller(const Site& site, const std::vector<sim::Planting>& plantings, PicturesWanted pictures,
                   int iterations, const sim::Growth& growth, Clock::time_point began);

  /// What the job will take, after an iteration: once growth has taken a fifth of the time that is still to
  /// come, or is `over`.
  std::optional<Foretold> after(const sim::Growth& growth, bool over);

 private:
  const Site& site_;
  const std::vector<sim::Planting>& plantings_;
  PicturesWanted pictures_;
  sim::Bricks near_surfaces_;
  LitWorld lit_before_;
  int iterations_;
  Clock::time_point job_began_, growth_began_ = Clock::now();
  double segments_before_;
  double later_s_ = 0.0;      // the least that comes after growth
  double ask_again_s_ = 0.0;  // looking ahead takes time of its own
};

/// Of pictures of what has grown, which stands in the site's world.
Foretold foretellPictures(const Site& site, const std::vector<sim::Planting>& plantings, const Grown& grown,
                          const PicturesWanted& pictures, Clock::time_point began);

/// Of a job for light alone, whose site is made. `space`: free voxels whose light is wanted too, or null.
Foretold foretellExposure(const Site& site, const sim::VoxelSet* space, const PicturesWanted& pictures,
                          Clock::time_point began);

}  // namespace espalier::scenes
