#pragma once
// Internal to the wing.
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "render/files/gltf_materials.h"
#include "render/files/needed.h"

namespace espalier::render {

using Bytes4 = std::array<std::uint8_t, 4>;

/// 0 to 1 as a normalized byte.
std::uint8_t byteOf(float share);

/// The iteration in which something of such a youth was placed, in steps of a kBirthSteps'th: whole ones are
/// exact, and what lies between two nodes is between theirs. `last`: PlantModel::last_birth.
inline constexpr float kBirthSteps = 16.0f;
float birthOf(float youth, std::int32_t last);

/// By what the tints of a mesh are divided to fit into 0..1, where `brightest` is the most of them: in few
/// steps, so that plants share materials, into which the same factor goes. No more than the material can
/// take, for no channel of it is above 1 and a picture's is 1 as it is: what is brighter then is cut off, and
/// the rest as bright as it should be.
float tintScale(const ModelMesh& mesh, float brightest);

/// A tint as bytes, which glTF takes for linear light.
Bytes4 bytesOf(sim::Colour tint, float scale);

/// The material of a plant's mesh; `scale`: of its tints, 1 where it has none.
int plantMaterial(GltfMaterials& materials, const ModelMesh& mesh, const std::string& name, PlantSurface kind,
                  float scale);

/// Triangles of a mesh that follow each other, and the vertices that they use.
struct MeshPart {
  std::vector<std::uint32_t> vertices;                  ///< of the mesh, rising
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of numbers among these

  /// What a part has of what all vertices have.
  template <class To, class From>
  std::vector<To> of(const std::vector<From>& values) const {
    std::vector<To> own;
    own.reserve(vertices.size());
    for (const std::uint32_t v : vertices) own.push_back(static_cast<To>(values[v]));
    return own;
  }
  template <class T>
  std::vector<T> of(const std::vector<T>& values) const {
    return of<T, T>(values);
  }
};

/// Parts of at most kMostShort vertices each, one after the other; some vertices may be in several. The whole
/// where these would be more than one in four. Parts begin with whole blades, so that all of a kind begin
/// alike.
void forEachPart(const ModelMesh& mesh, const Needed& needed,
                 const std::function<void(const MeshPart&)>& visit);

/// Places and triangles; normals and UVs where they are needed.
tinygltf::Primitive shapeOf(GlbFile& file, const ModelMesh& mesh, const Needed& needed, const MeshPart& part,
                            PlantSurface kind);

/// Adds a mesh; its number.
int addMesh(GlbFile& file, const std::string& name, std::vector<tinygltf::Primitive> primitives);

}  // namespace espalier::render
