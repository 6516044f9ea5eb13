#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/prepare/site.h"
#include "sim/base/vec.h"
#include "sim/light/lighting.h"
#include "sim/light/sky.h"

namespace espalier::scenes {

/// How exact a scene's maps of sky_exposure are: its own surfaces, seen by rays (Embree), and, where that is
/// asked for, shapes whose answer is known, built of voxels of the scene's own size and seen by its own sky.
/// Errors are value minus truth, in shares of the whole sky (0..1).
struct Certificate {
  /// One place in one shape (scenes/accuracy/known_shapes.h).
  struct Line {
    std::string shape;    ///< "endless street"
    std::string place;    ///< "middle of the floor"
    double size_m = 0.0;  ///< width of the street or court, diameter of the pit; 0 where size does not matter
    int voxels = 0;       ///< the same in voxels
    double truth = 0.0, value = 0.0;  ///< means over the place's voxels
    double rms = 0.0, worst = 0.0;    ///< of the single voxels' errors

    double error() const { return value - truth; }
  };
  /// Points drawn evenly by area on the scene's triangles, all that light could reach: in gaps and at edges
  /// too, and where the map has no value, which counts as 0.
  struct SpotCheck {
    std::size_t points = 0;    ///< compared
    std::size_t left_out = 0;  ///< drawn, but inside of solids or outside of the world
    int rays = 0;              ///< from each point
    double bias = 0.0, rms = 0.0, median = 0.0, percentile_95 = 0.0;  ///< the last two of the error's size
    std::size_t on_faces = 0;  ///< points that face as their voxel does, with no gap narrower than a voxel
    double rms_on_faces = 0.0, size_on_faces = 0.0;  ///< of their errors, and the mean of the errors' sizes
    /// The mean sizes of what the sky's directions make of the error on faces, and of what the voxels make:
    /// of some of the points, by a map with several times as many directions.
    double size_of_directions = 0.0, size_of_voxels = 0.0;
    struct Worst {
      sim::Vec3 at_m{0.0};
      std::string object, region;
      double truth = 0.0, value = 0.0;
    } worst;
  };

  sim::Weighting weighting = sim::Weighting::uniform;
  std::size_t directions = 0;
  double voxel_m = 0.0;
  std::vector<Line> lines;         ///< of known shapes
  double bias = 0.0, rms = 0.0;    ///< mean of the lines' errors; root of the mean square of their rms
  std::optional<SpotCheck> spots;  ///< where the scene has triangles that light can reach
};

/// Of a scene and the light of its world, without random rays: the spot check, drawn by the scene's seed.
Certificate certify(const Site& site, const sim::Lighting& light, std::uint64_t seed);

/// The same, and shapes whose width is 8, 16, 32 and 64 voxels of the scene, as far as they are no wider than
/// the scene's longest side, and as high (the pit: as deep as its radius). The street, which must be very
/// long, goes to 32.
Certificate certifyWithShapes(const Site& site, const sim::Lighting& light, std::uint64_t seed);

/// Of a voxel size and a sky: the shapes alone.
Certificate certifyShapes(const sim::Sky& sky, double voxel_m, const std::vector<int>& widths);

/// A table to be read on a terminal or in a report. Names the weighting.
std::string toText(const Certificate& certificate);
std::string toJson(const Certificate& certificate);
/// The spot check in three lines, the last of which says what would help most.
std::string inShort(const Certificate& certificate);

}  // namespace espalier::scenes
