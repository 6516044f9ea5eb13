#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/relief/drain.h"
#include "sim/relief/land.h"
#include "sim/relief/lines.h"
#include "sim/relief/raster.h"

/// Trees in plan become land.
namespace espalier::sim {

struct ReliefNoise {
  double amplitude_m = 0.0;  ///< its standard deviation, far from lines, of the first octave
  double scale_m = 100.0;    ///< the longest wave
  int octaves = 4;           ///< each of half the scale of the one before it, and half the amplitude
};

struct ReliefLaw {
  RiseLaw line;
  Flank flank;
  bool falls = false;    ///< lines lie highest: they fall from their roots, and land falls beside them
  double width_m = 0.0;  ///< of a line that drains one tip
  std::optional<double> floor_m = {};  ///< no land is lower: a sea, or a plain
  ReliefNoise noise;
};

struct Relief {
  HeightRaster raster;
  std::vector<double> flow;           ///< of each node's line
  std::vector<Course> courses;        ///< of all lines, as land was made of them
  std::vector<float> beside_m;        ///< of each sample: how far the nearest line's rim is, 0 on it
  std::vector<std::int32_t> nearest;  ///< of each sample: that line, by its number among courses
  SampledLines water;                 ///< none where lines lie highest
};

/// The bytes that making it takes.
double reliefBytes(const HeightRaster& raster, const PlanLines& lines, const ReliefNoise& noise);

/// Land of lines, of which there is at least one: `raster` says where, its heights are made. Where lines lie
/// low, one that would lie above the land beside it is lowered to it, and so is what it flows into; and water
/// runs down to outlets from everywhere, or to the floor, along each line without leaving it. The same on any
/// number of threads. Throws BrokenContract without a line; Stopped.
Relief makeRelief(HeightRaster raster, const PlanLines& lines, const ReliefLaw& law, std::uint64_t stream);

}  // namespace espalier::sim
