#pragma once
#include <optional>
#include <stdexcept>
#include <vector>

#include "scenes/scene.h"
#include "sim/grow/grow.h"
#include "sim/light/random_sky.h"
#include "sim/light/sky.h"
#include "sim/light/sun.h"
#include "sim/tile/build_world.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// A mesh that the scene calls optional is not there.
class MeshMissing : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A scene made ready to grow: its meshes read and tiled, its plants' rules and seeds in voxel space.
struct Job {
  Scene scene;
  std::vector<sim::TiledMesh> meshes;
  std::vector<sim::FillReport> fills;
  sim::World world;
  std::vector<sim::Planting> plantings;
  sim::Sky sky;
  std::optional<sim::RandomSky> random_sky;  ///< where the scene asks for it: instead of sky's directions
  sim::Sun sun;
};

/// Throws sim::InputError, naming the scene's file where the fault is the scene's; MeshMissing.
Job prepareJob(Scene scene);

/// Settings that the scene gives; the caller adds progress and stop.
sim::GrowthSettings growthSettings(const Job& job);

}  // namespace espalier::scenes
