#pragma once
#include <map>
#include <string>
#include <vector>

#include "scenes/accuracy/certificate.h"
#include "scenes/accuracy/known_shapes.h"

namespace espalier::scenes {

/// How a map is made of some of a world's surfaces, those that can be lit.
struct SurfaceMap {
  std::vector<sim::TiledVoxel> surfaces;
  std::vector<float> values;
};

/// The program's own (sim/light/surface.h, sim/light/evened.h), one for each weighting.
std::vector<SurfaceMap> mapsOf(const sim::World& world, const std::vector<sim::TiledVoxel>& surfaces,
                               const sim::Sky& sky, const std::vector<sim::Weighting>& weightings);

/// The plain answer of voxels, for comparison: everything that is touched takes light, and a surface is
/// judged from the middle of the next voxel before it.
SurfaceMap plainMap(const sim::World& world, const std::vector<sim::TiledVoxel>& surfaces,
                    const sim::Sky& sky);

/// A shape's world. Scenes' walls lie anywhere between the borders of voxels: each number is another place
/// (Roberts' R3 sequence, 2018); at 0 the shape's lowest corner lies on a border.
sim::World worldOf(const KnownShape& shape, double voxel_m, int place);

/// Some of a shape's surface voxels by the names of their places.
std::map<std::string, std::vector<sim::TiledVoxel>> byPlace(const KnownShape& shape, const sim::World& world);

/// A map's errors at one of them.
Certificate::Line errorsOf(const KnownShape& shape, const sim::World& world, sim::Weighting weighting,
                           const std::string& place, const SurfaceMap& map);

/// By the program's own maps: for each weighting a line for each place.
std::vector<std::vector<Certificate::Line>> compareShape(const KnownShape& shape, const sim::Sky& sky,
                                                         const std::vector<sim::Weighting>& weightings,
                                                         double voxel_m, int place);

}  // namespace espalier::scenes
