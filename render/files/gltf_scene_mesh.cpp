#include "render/files/gltf_scene_mesh.h"

#include <array>
#include <map>

#include "render/files/surfaces.h"

namespace espalier::render {
namespace {

int sceneMaterial(GltfMaterials& materials, const sim::Material& material) {
  if (material.texture == nullptr) return materials.of(material, -1);
  const sim::Texture& texture = *material.texture;
  return materials.of(material,
                      materials.textureOf(texture.name, texture.bytes, texture.mime_type, texture.wrap));
}

/// Where vertices are places and nothing else, one for all in the same.
void joinSamePlaces(MaterialSurface& surface) {
  if (!surface.normals.empty() || !surface.uvs.empty()) return;
  const auto key = [](sim::Vec3f p) { return std::array<float, 3>{p.x, p.y, p.z}; };
  std::map<std::array<float, 3>, std::uint32_t> numbers;
  std::vector<std::uint32_t> number_of;
  number_of.reserve(surface.positions_m.size());
  std::vector<sim::Vec3f> places;
  for (const sim::Vec3f place : surface.positions_m) {
    const auto [found, added] = numbers.try_emplace(key(place), static_cast<std::uint32_t>(places.size()));
    if (added) places.push_back(place);
    number_of.push_back(found->second);
  }
  surface.positions_m = std::move(places);
  for (auto& triangle : surface.triangles)
    for (std::uint32_t& corner : triangle) corner = number_of[corner];
}

}  // namespace

void addSceneMesh(GlbFile& file, GltfMaterials& materials, const sim::Mesh& mesh) {
  tinygltf::Mesh result;
  result.name = validUtf8(mesh.name);
  for (MaterialSurface& surface : surfacesOf(mesh)) {
    joinSamePlaces(surface);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = file.positions(surface.positions_m);
    if (!surface.normals.empty()) primitive.attributes["NORMAL"] = file.normals(surface.normals);
    if (!surface.uvs.empty()) primitive.attributes["TEXCOORD_0"] = file.uvs(surface.uvs);
    primitive.indices = file.indices(surface.triangles, surface.positions_m.size());
    primitive.material = sceneMaterial(materials, mesh.materials[surface.material]);
    result.primitives.push_back(std::move(primitive));
  }
  if (result.primitives.empty()) return;
  file.model().meshes.push_back(std::move(result));
  file.model().scenes[0].nodes.push_back(file.node(mesh.name, sizeOf(file.model().meshes) - 1));
}

}  // namespace espalier::render
