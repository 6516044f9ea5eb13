#pragma once
#include <cstdint>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

#include "render/model/model_mesh.h"
#include "sim/base/vec.h"

namespace espalier::render {

inline constexpr double kPi = std::numbers::pi;

/// A place on the centre line of a tube.
struct TubeStation {
  sim::Vec3 centre_m{0.0};
  double radius_m = 0.0;
  float exposure = 0.0f;
  float youth = 0.0f;
};

/// The cross-section's axes at a station; right-handed, unit: across x up = along.
struct TubeFrame {
  sim::Vec3 along, across, up;
};

/// Frames that turn no more about the line than the line itself turns (Wang, Juettler, Zheng and Liu 2008,
/// double reflection): no twist, no flips. Neighbouring centres must differ. A turn from one tangent to the
/// next by a quaternion would take half their angle and the unit axis, (cos a/2, sin a/2 * n); with the whole
/// angle and the bare cross product, as one finds it printed, frames turn twice as far and shrink. Two
/// reflections need neither angle nor axis.
/// `along`: unit, one a station; `across`: the first station's, any that is not parallel to its `along`.
std::vector<TubeFrame> rotationMinimizingFrames(std::span<const TubeStation> line,
                                                std::span<const sim::Vec3> along, sim::Vec3 across);
/// The same with cross-sections in the mitre planes, begun anywhere.
std::vector<TubeFrame> rotationMinimizingFrames(std::span<const TubeStation> line);

/// The ways in which cross-sections look: along the chord over a tube's own thickness, so that a thick one
/// does not follow each wiggle of its centre line.
std::vector<sim::Vec3> chordsOverThickness(std::span<const TubeStation> line);

/// Leaves out stations whose rings would cross their neighbours' (not the ends), thins the tube where that is
/// not enough, and eases the thinning over its neighbourhood. Where it leaves a station out, `dropped` hears
/// of its number among those that stood. Returns the chordsOverThickness of what is left, none for fewer than
/// two stations.
std::vector<sim::Vec3> keepRingsApart(std::vector<TubeStation>& line,
                                      const std::function<void(std::size_t)>& dropped = {});

/// Appends a tube of `sides` faces, as few as it takes: open where it begins, for there it stands in
/// something, and coming to a point in its last station, whatever the radius there. UVs without a seam: u
/// around, v in metres along. Fewer than two stations append nothing.
void appendTube(ModelMesh& mesh, std::span<const TubeStation> line, int sides, std::uint32_t piece);

}  // namespace espalier::render
