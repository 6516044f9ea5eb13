#pragma once
#include <cstdint>
#include <vector>

#include "sim/relief/lines.h"
#include "sim/relief/raster.h"

/// Water that finds its way down on a raster.
namespace espalier::sim {

/// Lines as samples that follow each other side by side (never across a corner), so that the edges of any
/// mesh of the raster carry them.
struct SampledLines {
  std::vector<std::uint32_t> sample;  ///< those on a line, each once; what one leads to stands before it
  std::vector<std::int32_t> next;     ///< the number, in `sample`, of the one downstream; -1 for an outlet
};

/// Samples the lines inside a raster, from their roots up. A line that comes to one that was sampled before
/// joins it there. Outlets are roots, and where a line leaves the raster.
SampledLines sampledLines(const PlanLines& lines, const HeightRaster& raster);

/// The least by which one sample lies above the next: 1e-5 of the spacing, or where single precision does not
/// tell that apart the next number.
double leastFall(const HeightRaster& raster);

/// Lowers lines until each falls all the way to its outlet.
void carve(HeightRaster& raster, const SampledLines& lines);

/// Raises what lies too low for water to leave it (priority flood: Barnes, Lehman and Mulla 2014), until each
/// sample but outlets has one beside it, not across a corner, that is lower. Outlets are those of the lines,
/// or without any of them the raster's rim. What carve made is not changed.
void fillPits(HeightRaster& raster, const SampledLines& lines);

}  // namespace espalier::sim
