#pragma once
#include <string>
#include <vector>

#include "scenes/prepare/site.h"
#include "scenes/scene.h"
#include "sim/grow/growth.h"

namespace espalier::scenes {

/// Attractors of a scene on its site.
struct NamedPoints {
  std::string name;
  std::vector<sim::Vec3> at_vx;   ///< in free voxels of the world
  std::vector<sim::Vec3> normal;  ///< of each the unit normal of the surface it was strewn on; zero elsewhere
  std::vector<std::int32_t> wave = {};  ///< in which each comes; empty where all do at once
};

/// The attractors that a scene names, in its order. Points beyond the world and in what stands there are left
/// out; one on the surface of a mesh that stands there first steps out along its normal, or against it, to a
/// free voxel at most two widths away. `warnings` takes, each with its place: how many lay beyond the world,
/// how doubtful a mesh's inside is, how many of the wanted points found no room. Throws PlacedError
/// where none is left, for a mesh without the surface or the inside that is
/// asked for.
std::vector<NamedPoints> attractorsOf(const Scene& scene, const Site& site,
                                      std::vector<Problem>* warnings = nullptr);

/// The crowns of those plants whose rules state one, each strewn about its seeds: by the names that
/// crownOf gives. The same of what lies beyond the world and in what stands there.
std::vector<NamedPoints> crownsOf(const Scene& scene, const Site& site,
                                  const std::vector<sim::Planting>& plantings,
                                  std::vector<Problem>* warnings = nullptr);

/// The same as growth has them: by rules::attractorsNamed and the columns of such.
sim::Commons commonsOf(const std::vector<NamedPoints>& attractors);

}  // namespace espalier::scenes
