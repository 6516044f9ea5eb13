#pragma once
#include <functional>
#include <iosfwd>

#include "render/model/diced.h"
#include "sim/base/provenance.h"

namespace espalier::render {

/// Hands diced meshes over, one after the other, and the same ones whenever it is called. None needs to
/// outlive the call that it is handed to.
using DicedMeshes = std::function<void(const std::function<void(const DicedMesh&)>& take)>;

/// What the colours of diced meshes are.
enum class DicedLight {
  given,  ///< surfaces as they look in a light that the colours hold: they are shown as they are
  wanted  ///< surfaces' own colours, which whoever shows them is to light
};

/// A glTF 2.0 binary: a node for each mesh that is not empty, in metres, y up. COLOR_0 holds linear light in
/// 16 bits each; the one material is white, matt and double-sided, and where light is given it is unlit
/// (KHR_materials_unlit, which readers may do without). Throws InputError as writeGlb does, and wants such a
/// stream. Asks for the meshes once.
void writeDicedGlb(std::iostream& file, const DicedMeshes& meshes, DicedLight light,
                   const sim::Provenance& made_by = {});

/// The same as OBJ: an object for each mesh, whose vertices have their colours behind their places (v x y z r
/// g b, as display values: sRGB, 0..1). No materials.
void writeDicedObj(std::ostream& file, const DicedMeshes& meshes, const sim::Provenance& made_by = {});

}  // namespace espalier::render
