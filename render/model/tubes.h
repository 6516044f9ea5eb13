#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "render/model/model_mesh.h"
#include "sim/base/vec.h"

namespace espalier::render {

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
/// double reflection): no twist, no flips. Neighbouring centres must differ.
std::vector<TubeFrame> rotationMinimizingFrames(std::span<const TubeStation> line);

/// Thins a tube where it bends so sharply that its rings would cross, and eases the thinning over its
/// neighbourhood.
void limitRadiusByBend(std::span<TubeStation> line);

/// Appends a closed tube of `sides` faces: a flat cap at the start, a pointed one at the end. UVs: u once
/// around, v in metres along. Fewer than two stations append nothing.
void appendTube(ModelMesh& mesh, std::span<const TubeStation> line, int sides, std::uint32_t piece);

}  // namespace espalier::render
