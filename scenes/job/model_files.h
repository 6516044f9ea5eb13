#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/files/gltf.h"
#include "render/model/plant_model.h"
#include "scenes/prepare/site.h"
#include "scenes/scene.h"
#include "scenes/show/bounced_light.h"
#include "scenes/write/output_folder.h"
#include "sim/base/bits.h"
#include "sim/base/provenance.h"
#include "sim/grow/plant.h"
#include "sim/light/lighting.h"
#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// Which models of a scene are written beside plant.glb, and how (diced ones: scenes/job/diced_files.h).
struct ModelsWanted {
  int coarser = 0;         ///< 0 to 3: plant_lod1.glb and so on, each of a coarser level
  bool instances = false;  ///< in .glb files each kind of leaf is one mesh (EXT_mesh_gpu_instancing)
  bool obj = false;        ///< plant.obj too, with plant.mtl and the pictures that it names
  /// Those that are diced too, in these colours of voxels: ImageKind::first_pass or surface_colour.
  std::optional<ImageKind> diced = std::nullopt;
};

/// What they are made from. Borrowed: all must outlive the files.
struct ModelSources {
  const Site& site;
  std::span<const sim::Plant> plants;
  const sim::BitVolume& bare;                        ///< what the scene alone occupies
  const std::vector<render::PlantModel>& in_memory;  ///< where pictures need them; else made while written
  const sim::Provenance& made_by;
  const sim::Lighting& light;       ///< with sun_now, where first_pass is wanted
  const PictureLight& lit;          ///< beside it
  sim::Vec3 to_sun{0.0, 1.0, 0.0};  ///< of that
};

/// A site's meshes that models show.
std::vector<const sim::Mesh*> meshesOf(const Site& site);

/// The plants as models, one after the other.
render::PlantModels modelsFrom(const ModelSources& sources, int level, bool instances);

/// The files' names, but for those of pictures, which follow from what has grown.
std::vector<std::string> modelFileNames(const ModelsWanted& wanted);

/// The files. `modelled` sees, while plant.glb is written, each plant's number and its model.
std::vector<OutputFile> modelFiles(const ModelsWanted& wanted, const ModelSources& sources,
                                   std::function<void(std::size_t, const render::PlantModel&)> modelled);

}  // namespace espalier::scenes
