#pragma once
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "render/model/plant_model.h"
#include "sim/base/provenance.h"
#include "sim/tile/mesh.h"

namespace espalier::render {

/// What a picture or a model file shows. Borrowed: everything must outlive the call.
struct ModelScene {
  std::vector<const sim::Mesh*> meshes;
  std::vector<const PlantModel*> plants;
};

/// Hands models of plants over, one after the other, and the same ones whenever it is called. None needs to
/// outlive the call that it is handed to.
using PlantModels = std::function<void(const std::function<void(const PlantModel&)>& take)>;

/// A glTF 2.0 binary (.glb): a node for each scene mesh and, under a node for each plant, one for its stems
/// and one for each of its elements. Metres, y up. Scene meshes keep their materials, textures, UVs and
/// normals. Materials of plants carry the base colours, or the picture of a leaf in their place, which cuts
/// it out; leaves are double-sided. COLOR_0 of a plant, where it has tints, is what its colour is multiplied
/// by; _EXPOSURE, _AGE, _BIRTH and _ORDER are a float each: exposure, 0..1, as the plant sensed it where it
/// grew; 0 for what the first iteration placed .. 1 for the last; that iteration, from 0; 0 for trunks, 1 for
/// what leaves them, and so on. Empty meshes are left out. The same scene gives the same bytes. Throws
/// InputError when a mesh's index is out of range, and when the file would have 4 GB or more, which the
/// format cannot hold. `made_by` goes into `asset`: the software as its generator, the rest as its extras.
/// The stream must be one that can be sought in and read back. Asks for the models once, and keeps none.
void writeGlb(std::iostream& file, const std::vector<const sim::Mesh*>& meshes, const PlantModels& plants,
              const sim::Provenance& made_by = {});
/// The same in memory.
std::string glbBytes(const ModelScene& scene, const sim::Provenance& made_by = {});

}  // namespace espalier::render
