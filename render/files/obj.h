#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "render/files/gltf.h"
#include "sim/base/provenance.h"
#include "sim/tile/mesh.h"

namespace espalier::render {

/// A picture that an MTL file names.
struct ObjPicture {
  std::string file;
  std::string bytes;
};

/// What an OBJ file names: its materials, and their pictures, called after `stem`: stem_1.png, stem_2.jpg.
struct ObjLibrary {
  std::string mtl;
  std::vector<ObjPicture> pictures;  ///< each once
};

/// The materials of a model. Kd and Ke, what is sent out, are display values (sRGB), as a colour picker shows
/// them, up to 1; map_Kd is a picture, and map_d the same one where it cuts out.
ObjLibrary objLibrary(const std::vector<const sim::Mesh*>& meshes, const PlantModels& plants,
                      const std::string& stem, const sim::Provenance& made_by = {});

/// The shapes of the same model: an object for each scene mesh and each plant, a group in it for each of a
/// plant's stems, stalks and kinds of elements; metres, y up, with UVs and normals where there are some.
/// Names have underscores for spaces. What OBJ has no place for is left out: tints, exposures, ages, orders.
/// Streamed; keeps no model. Throws InputError when a mesh's index is out of range.
void writeObj(std::ostream& file, const std::vector<const sim::Mesh*>& meshes, const PlantModels& plants,
              const std::string& stem, const sim::Provenance& made_by = {});

}  // namespace espalier::render
