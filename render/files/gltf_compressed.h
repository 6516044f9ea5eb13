#pragma once
// Internal to the wing.
#include "render/files/glb_file.h"
#include "render/files/gltf_surfaces.h"
#include "render/model/model_mesh.h"

namespace espalier::render {

/// A part of a mesh by KHR_draco_mesh_compression, which the file then cannot be read without: what is
/// needed, and _EXPOSURE, _AGE, _BIRTH, _ORDER, and tints over `tint_scale` where it has some. Places are off
/// by a 120th of `least_m` at most each way, UVs by a thousandth, exposures and ages by a 500th; births and
/// orders are as they are.
tinygltf::Primitive compressed(GlbFile& file, const ModelMesh& mesh, const Needed& needed,
                               const MeshPart& part, double least_m, std::int32_t last_birth,
                               float tint_scale);

}  // namespace espalier::render
