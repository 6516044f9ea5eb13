#pragma once
// Internal to the wing.
#include "render/files/gltf_materials.h"
#include "sim/tile/mesh.h"

namespace espalier::render {

/// Adds a scene mesh with a node of its own: a primitive for each material that is in use, with the vertices
/// that it uses, and what UVs and normals they have. Nothing where it is empty. Throws InputError when an
/// index is out of range.
void addSceneMesh(GlbFile& file, GltfMaterials& materials, const sim::Mesh& mesh);

}  // namespace espalier::render
