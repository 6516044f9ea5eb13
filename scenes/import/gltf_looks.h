#pragma once
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "scenes/import/gltf_buffers.h"
#include "scenes/import/texture_files.h"
#include "sim/tile/mesh.h"

namespace espalier::scenes::gltf {

/// What a glTF material says, and by which UVs its texture lies.
struct Looks {
  sim::Material material;      ///< without a name where the file gives none
  std::size_t uv_set = 0;      ///< TEXCOORD_n
  glm::dmat3 uv_from_uv{1.0};  ///< of KHR_texture_transform, v downwards
};

/// The document's materials: glTF's metallic-roughness model with its base colour's texture; no other
/// textures. Throws sim::InputError, naming the material, for numbers that are none. A texture that is not to
/// be had becomes a warning in `textures`.
std::vector<Looks> looksOf(const Json& document, const Buffers& buffers, const FileBeside& file_beside,
                           TextureFiles& textures);

}  // namespace espalier::scenes::gltf
