#pragma once
// Internal to the wing.
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "render/files/glb_file.h"
#include "sim/tile/mesh.h"

namespace espalier::render {

/// The materials, textures and images of a file: each once, however many ask for it.
class GltfMaterials {
 public:
  using Wraps = std::array<sim::Texture::Wrap, 2>;

  explicit GltfMaterials(GlbFile& file) : file_(file) {}

  /// Of two that differ in nothing the number is the same. `texture`: -1 for none; the material's own is not
  /// looked at.
  int of(const sim::Material& material, int texture);
  int textureOf(const std::string& name, std::string_view bytes, const std::string& mime_type,
                const Wraps& wrap);

 private:
  int imageOf(const std::string& name, std::string_view bytes, const std::string& mime_type);
  int samplerOf(const Wraps& wrap);

  using Key = std::tuple<std::string, std::array<float, 10>, sim::Material::Alpha, bool, int>;
  GlbFile& file_;
  std::map<Key, int> materials_;
  std::map<std::pair<std::uint64_t, std::size_t>, int> images_;  // by their bytes' hash and number
  std::map<Wraps, int> samplers_;
  std::map<std::pair<int, int>, int> textures_;  // by image and sampler
};

}  // namespace espalier::render
