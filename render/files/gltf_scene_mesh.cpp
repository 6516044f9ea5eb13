#include "render/files/gltf_scene_mesh.h"

#include "render/files/surfaces.h"

namespace espalier::render {
namespace {

int sceneMaterial(GltfMaterials& materials, const sim::Material& material) {
  if (material.texture == nullptr) return materials.of(material, -1);
  const sim::Texture& texture = *material.texture;
  return materials.of(material,
                      materials.textureOf(texture.name, texture.bytes, texture.mime_type, texture.wrap));
}

}  // namespace

void addSceneMesh(GlbFile& file, GltfMaterials& materials, const sim::Mesh& mesh) {
  tinygltf::Mesh result;
  result.name = validUtf8(mesh.name);
  for (MaterialSurface& surface : surfacesOf(mesh)) {
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
