#pragma once
#include <optional>
#include <stdexcept>
#include <vector>

#include "scenes/import/facing.h"
#include "scenes/import/skeleton_forest.h"
#include "scenes/prepare/fields.h"
#include "scenes/problem.h"
#include "scenes/scene.h"
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

/// Where plants will stand and light falls: what a scene says of the world, made once and kept. Of the
/// scene's plants it knows how far they feel (world.layers()); whether they can grow there is not asked.
/// Nothing changes it but growth, where a run lets its plants grow in the site's own world.
struct Site {
  std::vector<sim::TiledMesh> meshes;  ///< as placed, world metres
  std::vector<sim::Mesh> shapes;       ///< placed likewise, but no part of the world: for attractors
  std::vector<std::vector<sim::Vec3>> listed_m;  ///< what tables of points list, as forEachTable has them
  std::vector<std::vector<FileTree>> skeletons;  ///< of each of the scene's plants, placed: in metres
  std::vector<FieldVolume> fields;               ///< of each of the scene's fields
  std::vector<FacingReport> facings;             ///< of meshes with triangles that were turned
  std::vector<sim::FillReport> fills;            ///< of the solid ones, and of what was found to be closed
  sim::World world;                              ///< with nothing but the meshes in it
  sim::Sky sky;
  std::optional<sim::RandomSky> random_sky;  ///< where the scene asks for it: instead of sky's directions
  sim::Sun sun;
  std::vector<sim::InputFile>
      mesh_files;  ///< what meshes, points, skeletons and volumes were read from, each once
  std::vector<std::filesystem::path> mesh_paths;  ///< where those are
  std::vector<Problem> warnings;                  ///< of what mesh files name and have not, and of fields
};

/// The site's mesh of that name, tiled or not. Throws sim::InputError where it has none.
const sim::Mesh& meshNamed(const Site& site, const std::string& name);

/// How much of a mesh's inside is doubtful, in a sentence for a warning.
std::string leakOf(const std::string& mesh, const sim::InsideDoubt& doubt);

/// Reads a scene's meshes and tiles them, with layersFor() boundary layers. Throws sim::InputError, naming
/// the scene's file where the fault is the scene's; MeshMissing.
Site makeSite(const Scene& scene);

/// The same without boundary layers and without a look at the plants, and by default a finer sky: for light
/// alone.
Site makeSiteForLight(Scene scene);

/// The boundary layers of a scene's world: as many as it says, or as the rules of its plants need to feel
/// every distance that they ask for. Throws sim::InputError, with the place in the scene's file, where that
/// is more than kMostLayers.
int layersFor(const Scene& scene, const sim::Frame& frame);

/// Throws sim::InputError, naming the scene's file, where a camera's eye lies in an occupied voxel.
void requireCamerasInTheOpen(const Scene& scene, const sim::World& world);

}  // namespace espalier::scenes
