#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "render/model/plant_model.h"
#include "scenes/prepare/site.h"
#include "scenes/write/output_folder.h"
#include "sim/base/bits.h"
#include "sim/base/provenance.h"
#include "sim/grow/plant.h"

namespace espalier::scenes {

/// Which models of a scene are written beside plant.glb, and how.
struct ModelsWanted {
  int coarser = 0;         ///< 0 to 3: plant_lod1.glb and so on, each of a coarser level
  bool instances = false;  ///< in .glb files each kind of leaf is one mesh (EXT_mesh_gpu_instancing)
  bool obj = false;        ///< plant.obj too, with plant.mtl and the pictures that it names
};

/// What they are made from. Borrowed: all must outlive the files.
struct ModelSources {
  const Site& site;
  std::span<const sim::Plant> plants;
  const sim::BitVolume& bare;                        ///< what the scene alone occupies
  const std::vector<render::PlantModel>& in_memory;  ///< where pictures need them; else made while written
  const sim::Provenance& made_by;
};

/// The files' names, but for those of pictures, which follow from what has grown.
std::vector<std::string> modelFileNames(const ModelsWanted& wanted);

/// The files. `meeting` hears, while plant.glb is written, of each plant's number and its limbs that meet.
std::vector<OutputFile> modelFiles(const ModelsWanted& wanted, const ModelSources& sources,
                                   std::function<void(std::size_t, std::size_t)> meeting);

}  // namespace espalier::scenes
