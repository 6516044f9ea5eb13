#pragma once
#include <memory>
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "scenes/write/output_folder.h"
#include "sim/base/picture.h"
#include "sim/base/provenance.h"
#include "sim/grow/growth.h"
#include "sim/light/sky.h"
#include "sim/relief/relief.h"
#include "sim/tile/mesh.h"
#include "sim/world/field.h"
#include "sim/world/world.h"

/// Land that is made of what has grown (Scene::heights).
namespace espalier::scenes {

struct MadeHeights {
  std::string name;
  sim::Relief relief;
  /// One for each cover that is seen somewhere, and one for what none covers, called as they are; a region
  /// each. All have one texture.
  std::vector<sim::Mesh> meshes;
  std::shared_ptr<const sim::Picture> picture;  ///< the texture's

  // Only where it is drawn: a world of its own, with the sky that is seen from each of its free voxels.
  std::shared_ptr<const sim::World> world;
  std::shared_ptr<const sim::ExposureField> sky;
};

/// All of a scene's, in their order. `sky`: of those that are drawn; null: none is. Throws PlacedError where
/// a planting has no line over the land, or it does not fit into memory; Stopped.
std::vector<MadeHeights> makeHeights(const Scene& scene, const sim::Growth& growth, const sim::Frame& frame,
                                     const sim::Sky* sky);

/// What they are written as: NAME.exr, heights in metres with samples from -z to z in rows along x, and
/// NAME.glb.
std::vector<std::string> heightFileNames(const Scene& scene);
std::vector<OutputFile> heightFiles(const std::vector<MadeHeights>& made, const sim::Provenance& made_by);

/// Whether an image of vines shows heights.
bool showsHeights(const ImageSpec& image);

}  // namespace espalier::scenes
