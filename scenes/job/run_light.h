#pragma once
#include <memory>
#include <vector>

#include "scenes/job/model_files.h"
#include "scenes/job/stages.h"
#include "scenes/prepare/site.h"
#include "scenes/show/bounced_light.h"
#include "scenes/show/pictures.h"
#include "sim/light/lighting.h"

/// The light of what has grown in a run.
namespace espalier::scenes {

/// The free voxels of the boundary layers, which lie around the scene.
sim::VoxelSet openLayers(const sim::BitVolume& scene, const sim::World& grown);

/// `images`: those that are drawn. `layers`: free space where light is wanted too, beside all of it for
/// images of vines, whose leaves are lit by what is around them. `bare`: what the scene alone occupies, for
/// those that show no plant. `models`: those that are written. Throws PlacedError where it does not fit into
/// memory.
sim::Lighting lightFor(const Scene& scene, const Site& site, const std::vector<ImageSpec>& images,
                       const sim::BitVolume& bare, std::shared_ptr<const sim::VoxelSet> layers,
                       const ModelsWanted& models = {});

/// How the pictures that are drawn, of whatever has grown, a film if there is to be one, and models that look
/// like them are lit. `light` is told of it.
PictureLight litFor(const Scene& scene, const Site& site, const std::vector<sim::Plant>& plants,
                    sim::Lighting& light, const PicturesWanted& pictures, const ModelsWanted& models,
                    Stages& stages);

}  // namespace espalier::scenes
