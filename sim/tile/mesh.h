#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::sim {

/// A picture that is laid on surfaces by their UVs: a file as it was, which nothing here looks into.
struct Texture {
  enum class Wrap { repeat, clamp, mirror };
  std::string name;
  std::string mime_type;  ///< image/png or image/jpeg
  std::string bytes;
  std::array<Wrap, 2> wrap{};  ///< along u and v, beyond 0..1
};

/// What a surface looks like, in glTF's terms. Growth and light know the colour alone.
struct Material {
  enum class Alpha { opaque, mask, blend };
  std::string name;
  Colour colour{0.6f};                      ///< linear RGB base colour
  float alpha = 1.0f;                       ///< 0..1
  float roughness = 0.9f, metallic = 0.0f;  ///< 0..1
  Colour emissive{0.0f};                    ///< linear RGB, at least 0
  Alpha alpha_mode = Alpha::opaque;
  float alpha_cutoff = 0.5f;  ///< where masked: alpha below it is cut out
  bool double_sided = true;   ///< meshes may be inside out: a wall must not vanish from behind
  std::shared_ptr<const Texture> texture = nullptr;  ///< by which the colour is multiplied; null: none
};

/// How much of what is behind it a material hides: 0 all is seen through it .. 1 nothing is.
inline float opacityOf(const Material& material) {
  return material.alpha_mode == Material::Alpha::blend ? material.alpha : 1.0f;
}
/// `opacity`: 0..1. What is cut out by a mask stays so where it is opaque.
inline void setOpacity(Material& material, double opacity) {
  material.alpha = static_cast<float>(opacity);
  if (opacity < 1.0)
    material.alpha_mode = Material::Alpha::blend;
  else if (material.alpha_mode == Material::Alpha::blend)
    material.alpha_mode = Material::Alpha::opaque;
}

/// A triangle mesh as a plain value. Nothing is assumed of it: real meshes are open, inside out and unwelded.
struct Mesh {
  std::string name;
  std::vector<Vec3> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into vertices_m, all in range
  std::vector<std::uint32_t> region;                    ///< per triangle: index into regions
  std::vector<std::uint32_t> material;                  ///< per triangle: index into materials
  /// Per vertex, as the file had them, to be handed on; empty: it had none. Zero: this vertex has none.
  std::vector<glm::vec2> uvs;        ///< v upwards
  std::vector<Vec3f> normals;        ///< unit
  std::vector<std::string> regions;  ///< named parts that rules and scenes refer to
  std::vector<Material> materials;
  std::size_t degenerate_dropped = 0;  ///< zero-area triangles that the importer left out
};

/// A normal of length 1; zero, for none, where it has no direction.
Vec3f unitOrNone(const Vec3& normal);

/// A hash of all that a world could be made of: not the names of the mesh and its materials, nor what else is
/// only looked at.
std::uint64_t contentHash(const Mesh& mesh);

}  // namespace espalier::sim
