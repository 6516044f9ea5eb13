#pragma once
#include <functional>
#include <string>
#include <vector>

#include "sim/base/vec.h"
#include "sim/light/sky.h"
#include "sim/tile/build_world.h"

/// Shapes from which the share of the sky that is seen is known, at every place and for every weighting.
namespace espalier::scenes {

/// What hides the sky at a place: the elevation, in radians, up to which it is hidden, by azimuth (radians;
/// 0 along +x, turning to +z).
using Skyline = std::function<double(double azimuth)>;

/// What a receiver at a place with this skyline gets of the sky, 0..1, by quadrature over the azimuth. The
/// normal must be level or upright. The ground and its own back are hidden from a receiver anyway.
double skySeen(sim::Weighting weighting, const Skyline& skyline, sim::Vec3 normal);

/// Names of places.
inline constexpr const char *kMiddleOfTheFloor = "middle of the floor", *kFloor = "floor", *kWalls = "walls",
                            *kAll = "all";

/// A shape that stands on the plane y = 0 about the origin.
struct KnownShape {
  std::string name;
  sim::TiledMesh mesh;
  double size_m = 0.0;  ///< width or diameter; 0 where size does not matter
  /// The name of the place where a point of the surface lies; empty where nothing is compared.
  std::function<std::string(sim::Vec3 p_m, sim::Vec3 normal)> place;
  std::function<double(sim::Weighting, sim::Vec3 p_m, sim::Vec3 normal)> truth;
};

/// A street without ends: 60 times as long as it is wide or high, which counts as endless. Along z, or turned
/// about the vertical. Compared across its middle.
KnownShape street(double width_m, double height_m, double turn_deg, double voxel_m);
/// A square court, turned by an angle about the vertical.
KnownShape court(double width_m, double height_m, double turn_deg, double voxel_m);
/// A round pit. Compared about its middle.
KnownShape pit(double diameter_m, double depth_m, double voxel_m);
/// Level ground under a square roof without walls. Compared under the roof.
KnownShape canopy(double width_m, double height_m, double voxel_m);
/// A plane tilted by an angle, falling towards an azimuth. Nothing hides the sky before it.
KnownShape slope(double tilt_deg, double toward_deg, double size_m);

}  // namespace espalier::scenes
