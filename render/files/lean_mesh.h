#pragma once
// Internal to the wing.
#include "render/files/surfaces.h"
#include "render/model/model_mesh.h"

namespace espalier::render {

/// The same surface without what glTF can do without: UVs of stems on which no picture lies; those of stalks,
/// and their normals; normals of blades that are the facets' own, which glTF has readers compute. One vertex
/// stands for all that then differ in nothing, at a point of stems or within a blade. An empty mesh where all
/// is needed.
ModelMesh leanMesh(const ModelMesh& mesh, PlantSurface kind);

}  // namespace espalier::render
