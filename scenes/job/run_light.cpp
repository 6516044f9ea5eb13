#include "scenes/job/run_light.h"

#include <algorithm>

#include "scenes/lights.h"
#include "scenes/prepare/in_scene.h"
#include "scenes/show/vines_picture.h"
#include "scenes/show/volume_picture.h"
#include "sim/tile/build_world.h"
#include "sim/world/band.h"

namespace espalier::scenes {

sim::VoxelSet openLayers(const sim::BitVolume& scene, const sim::World& grown) {
  return sim::VoxelSet(sim::freeBand(grown, scene, grown.layers()));
}

sim::Lighting lightFor(const Scene& scene, const Site& site, const std::vector<ImageSpec>& images,
                       const sim::BitVolume& bare, std::shared_ptr<const sim::VoxelSet> layers,
                       const ModelsWanted& models) {
  const bool vines = drawsVines(images);
  sim::LightWanted wanted;
  if (models.diced == ImageKind::first_pass || scene.interreflection || drawsVolumes(images))
    wanted.to_sun = shadowDirection(scene.sun);
  wanted.space = std::move(layers);
  wanted.dense = vines;
  if (vines && std::any_of(images.begin(), images.end(), showsNoPlant)) wanted.bare = &bare;
  const double fields = wanted.bare ? 3.0 : 2.0;  // of 16 bits
  if (vines) inScene(scene, [&] { sim::requireFits(site.world.frame(), {site.world.layers(), 2 * fields}); });
  wanted.random_sky = site.random_sky;
  return sim::lightOf(site.world, site.sky, site.sun, wanted);
}

PictureLight litFor(const Scene& scene, const Site& site, const std::vector<sim::Plant>& plants,
                    sim::Lighting& light, const PicturesWanted& pictures, const ModelsWanted& models,
                    Stages& stages) {
  LitKinds kinds = litKinds(pictures.images);
  kinds.vines = kinds.vines || pictures.film_frames > 0;
  kinds.first_pass = kinds.first_pass || models.diced == ImageKind::first_pass;
  const auto find = [&] {
    return pictureLight(scene, site.meshes, site.world, plants, light, kinds, shadowDirection(scene.sun));
  };
  return scene.interreflection && kinds.any() ? stages.run("bouncing light", find) : find();
}

}  // namespace espalier::scenes
