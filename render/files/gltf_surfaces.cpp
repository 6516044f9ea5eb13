#include "render/files/gltf_surfaces.h"

#include <algorithm>
#include <cmath>

namespace espalier::render {

std::uint8_t byteOf(float share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0f, 1.0f) * 255.0f));
}

float tintScale(const ModelMesh& mesh, float brightest) {
  constexpr float kStep = 0.125f;
  const sim::Colour c = mesh.picture == nullptr ? mesh.base_colour : sim::Colour(1.0f);
  const float most = 1.0f / std::max({c.r, c.g, c.b, 1e-3f});
  return std::min(std::max(std::ceil(brightest / kStep), 1.0f) * kStep, most);
}

Bytes4 bytesOf(sim::Colour tint, float scale) {
  return {byteOf(tint.r / scale), byteOf(tint.g / scale), byteOf(tint.b / scale), 255};
}

int plantMaterial(GltfMaterials& materials, const ModelMesh& mesh, const std::string& name, PlantSurface kind,
                  float scale) {
  constexpr float kStemRoughness = 0.9f, kLeafRoughness = 0.6f;
  sim::Material material;
  material.name = name;
  material.colour = scale * (mesh.picture == nullptr ? mesh.base_colour : sim::Colour(1.0f));
  material.roughness = kind == PlantSurface::blades ? kLeafRoughness : kStemRoughness;
  material.double_sided = kind == PlantSurface::blades;
  if (mesh.picture == nullptr) return materials.of(material, -1);
  const bool tiles = mesh.picture->tiles;
  if (!tiles) {
    material.alpha_mode = sim::Material::Alpha::mask;
    material.alpha_cutoff = kCutout;
    material.double_sided = true;
  }
  const auto wrap = tiles ? sim::Texture::Wrap::repeat : sim::Texture::Wrap::clamp;
  return materials.of(material,
                      materials.textureOf(mesh.picture->name, mesh.picture->png, "image/png", {wrap, wrap}));
}

tinygltf::Primitive shapeOf(GlbFile& file, const ModelMesh& mesh, PlantSurface kind) {
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = file.positions(mesh.positions_m);
  if (!mesh.normals.empty()) primitive.attributes["NORMAL"] = file.normals(mesh.normals);
  if (kind != PlantSurface::stalks)  // nothing is laid on those
    primitive.attributes["TEXCOORD_0"] = file.uvs(mesh.uvs, kind == PlantSurface::blades);
  primitive.indices = file.indices(mesh.triangles, mesh.positions_m.size());
  return primitive;
}

int addMesh(GlbFile& file, const std::string& name, tinygltf::Primitive primitive) {
  tinygltf::Mesh mesh;
  mesh.name = validUtf8(name);
  mesh.primitives.push_back(std::move(primitive));
  file.model().meshes.push_back(std::move(mesh));
  return sizeOf(file.model().meshes) - 1;
}

}  // namespace espalier::render
