#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scenes/prepare/site_files.h"
#include "scenes/scene.h"
#include "sim/light/random_sky.h"
#include "sim/light/sky.h"
#include "sim/light/sun.h"
#include "sim/tile/build_world.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// Where plants will stand and light falls: what a scene says of the world, made once and kept. Of the
/// scene's plants it knows how far they feel (world.layers()); whether they can grow there is not asked.
/// Nothing changes it but growth, where a run lets its plants grow in the site's own world.
struct Site : SiteFiles {
  std::vector<sim::FillReport> fills;  ///< of the solid ones, and of what was found to be closed
  sim::World world;                    ///< with nothing but the meshes in it
  sim::Sky sky;
  std::optional<sim::RandomSky> random_sky;  ///< where the scene asks for it: instead of sky's directions
  sim::Sun sun;
};

/// The site's mesh of that name, tiled or not. Throws sim::InputError where it has none.
const sim::Mesh& meshNamed(const Site& site, const std::string& name);

/// How much of a mesh's inside is doubtful, in a sentence for a warning.
std::string leakOf(const std::string& mesh, const sim::InsideDoubt& doubt);

/// Reads a scene's files and tiles its meshes, with layersFor() boundary layers. Throws PlacedError;
/// MeshMissing.
Site makeSite(const Scene& scene);
/// The same of files that were read before, which stay where they are if no world can be made of them.
Site makeSite(const Scene& scene, SiteFiles&& files);

/// The scene without what only plants want: boundary layers, attractors, fields, and the plants. By default
/// its sky is finer.
Scene forLight(Scene scene);
/// Its site.
Site makeSiteForLight(Scene scene);

/// The boundary layers of a scene's world: as many as it says, or as the rules of its plants need to feel
/// every distance that they ask for. Throws PlacedError where that is more than kMostLayers.
int layersFor(const Scene& scene, const sim::Frame& frame);

/// Throws PlacedError where a camera's eye lies in an occupied voxel.
void requireCamerasInTheOpen(const Scene& scene, const sim::World& world);
/// Throws PlacedError where no light gets out of a mesh that sends it out, as it lies in a solid.
void requireLampsInTheOpen(const Scene& scene, const Site& site);

}  // namespace espalier::scenes
