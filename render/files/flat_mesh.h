#pragma once
// Internal to the wing.
#include "render/model/model_mesh.h"

namespace espalier::render {

/// The same surface without its normals, where those are the facets' own, which glTF has readers compute; and
/// with one vertex for all that then differ in nothing within a piece. An empty mesh for any other surface.
ModelMesh withoutFlatNormals(const ModelMesh& mesh);

}  // namespace espalier::render
