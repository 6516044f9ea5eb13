#pragma once
#include <functional>
#include <string>
#include <vector>

#include "scenes/import/mesh_folder_io.h"
#include "scenes/import/obj_text.h"
#include "scenes/problem.h"
#include "scenes/scene.h"
#include "sim/tile/mesh.h"

struct aiScene;

namespace espalier::scenes {

/// Reads the OBJ file `name`, where `read_scene` has Assimp read a file that `io` shows. What the file names
/// and has not becomes a warning.
sim::Mesh readObj(MeshFolderIo& io, const std::string& name, RegionsFrom regions_from,
                  const std::string& stem,
                  const std::function<const aiScene&(const std::string& shown)>& read_scene,
                  std::vector<Problem>& warnings);

}  // namespace espalier::scenes
