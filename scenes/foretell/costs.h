#pragma once
#include <string>
#include <vector>

#include "scenes/foretell/speed.h"
#include "scenes/show/pictures.h"

/// What the stages of a job take, by what they work on: figures measured on one machine (costs.cpp), which
/// the benchmarks hold against whole runs.
namespace espalier::scenes {

struct StageCost {
  std::string stage;         ///< as a run names it
  Work work;                 ///< on the machine of costs.cpp
  double bytes_while = 0.0;  ///< at most, while it lasts, beyond what was held before
  double bytes_kept = 0.0;   ///< of these, when it is done
};

/// A world whose light is wanted.
struct LitWorld {
  double voxels = 0.0;
  double places = 0.0;  ///< free voxels beside what is occupied
  double sky_directions = 0.0, sun_directions = 0.0;
  double random_rays = 0.0;  ///< from each place, in place of the sky's directions
  double space = 0.0;        ///< free voxels where light is wanted too
  bool dense = false;        ///< in all voxels
};

/// What a camera sees.
struct Seen {
  double fragments = 0.0;  ///< all of its picture's
  int panels = 0;          ///< drawn of it
  bool shadows = false;    ///< one of them needs the sun's
};

StageCost lightingCost(const LitWorld& world);
/// Of a scene with interreflection; `kinds` of pictures have it, each by itself.
StageCost bouncingCost(const LitWorld& world, const InterreflectionSpec& asked, int kinds);
StageCost certifyingCost(const LitWorld& world);
StageCost countingCost(const LitWorld& world);
/// `triangles`: of the meshes and of all that has grown.
StageCost modellingCost(double triangles);
/// `cameras`: those that panels are drawn for.
StageCost drawingCost(const PicturesWanted& wanted, const std::vector<Seen>& cameras, double triangles);
/// Of a film's frames, in a world whose plants grow to so many triangles.
StageCost filmingCost(const PicturesWanted& wanted, const LitWorld& world, double triangles);
StageCost writingCost(const PicturesWanted& wanted, const LitWorld& world, double triangles);

}  // namespace espalier::scenes
