#include "scenes/import/mesh_wire.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "scenes/import/texture_files.h"
#include "scenes/import/wire.h"

namespace espalier::scenes {
namespace {

constexpr std::uint32_t kNoTexture = std::numeric_limits<std::uint32_t>::max();

void requireBelow(const std::vector<std::uint32_t>& indices, std::size_t limit) {
  if (std::any_of(indices.begin(), indices.end(), [&](std::uint32_t i) { return i >= limit; })) {
    throw std::runtime_error("an index is out of range");
  }
}

/// The textures of a mesh's materials, each once, and the number of each material's: that of none is theirs.
struct Textures {
  std::vector<std::shared_ptr<const sim::Texture>> all;
  std::vector<std::uint32_t> of_material;
};

Textures texturesOf(const sim::Mesh& mesh) {
  Textures textures;
  for (const sim::Material& material : mesh.materials) {
    auto at = std::find(textures.all.begin(), textures.all.end(), material.texture);
    textures.of_material.push_back(
        static_cast<std::uint32_t>(material.texture == nullptr ? kNoTexture : at - textures.all.begin()));
    if (material.texture != nullptr && at == textures.all.end()) textures.all.push_back(material.texture);
  }
  return textures;
}

void put(Packer& out, const sim::Material& material, std::uint32_t texture) {
  out.putText(material.name);
  out.put(material.colour);
  for (const float number : {material.alpha, material.roughness, material.metallic, material.alpha_cutoff})
    out.put(number);
  out.put(material.emissive);
  out.put(static_cast<std::uint32_t>(material.alpha_mode));
  out.put(static_cast<std::uint32_t>(material.double_sided));
  out.put(texture);
}

template <class T>
T getOneOf(Unpacker& in, T last) {
  const auto number = in.get<std::uint32_t>();
  if (number > static_cast<std::uint32_t>(last)) throw std::runtime_error("a choice is none");
  return static_cast<T>(number);
}

float getShare(Unpacker& in) {
  const auto value = in.get<float>();
  if (!(value >= 0.0f && value <= 1.0f)) throw std::runtime_error("a material's number is not from 0 to 1");
  return value;
}

std::shared_ptr<const sim::Texture> getTexture(Unpacker& in) {
  sim::Texture texture;
  texture.name = in.getText();
  texture.mime_type = in.getText();
  texture.bytes = in.getText();
  for (sim::Texture::Wrap& wrap : texture.wrap) wrap = getOneOf(in, sim::Texture::Wrap::mirror);
  if (texture.mime_type.empty() || texture.mime_type != mimeTypeOf(texture.bytes))
    throw std::runtime_error("a texture is no picture");
  return std::make_shared<sim::Texture>(std::move(texture));
}

sim::Material getMaterial(Unpacker& in, const std::vector<std::shared_ptr<const sim::Texture>>& textures) {
  sim::Material material;
  material.name = in.getText();
  material.colour = in.get<sim::Colour>();
  for (float* number : {&material.alpha, &material.roughness, &material.metallic, &material.alpha_cutoff})
    *number = getShare(in);
  for (int c = 0; c < 3; ++c) {
    material.emissive[c] = in.get<float>();
    if (!(material.emissive[c] >= 0.0f && std::isfinite(material.emissive[c])))
      throw std::runtime_error("a material sends out no light that is a number");
  }
  material.alpha_mode = getOneOf(in, sim::Material::Alpha::blend);
  material.double_sided = getOneOf(in, 1u) != 0;
  const auto texture = in.get<std::uint32_t>();
  if (texture == kNoTexture) return material;
  if (texture >= textures.size()) throw std::runtime_error("an index is out of range");
  material.texture = textures[texture];
  return material;
}

/// Of each vertex, or of none; finite, and normals of length 1 or 0.
void requireLooks(const sim::Mesh& mesh) {
  const auto each = [&](std::size_t count) { return count == 0 || count == mesh.vertices_m.size(); };
  if (!each(mesh.uvs.size()) || !each(mesh.normals.size()))
    throw std::runtime_error("not every vertex has UVs and a normal");
  for (const glm::vec2 uv : mesh.uvs) {
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) throw std::runtime_error("a UV is not finite");
  }
  for (const sim::Vec3f normal : mesh.normals) {
    const float length = glm::length(normal);
    if (!(length == 0.0f || std::abs(length - 1.0f) < 1e-3f)) throw std::runtime_error("a normal is none");
  }
}

}  // namespace

std::string packMesh(const sim::Mesh& mesh, const MeshSources& sources) {
  Packer out;
  out.putText(mesh.name);
  out.putArray(mesh.vertices_m.data(), mesh.vertices_m.size());
  out.putArray(mesh.triangles.data(), mesh.triangles.size());
  out.putArray(mesh.region.data(), mesh.region.size());
  out.putArray(mesh.material.data(), mesh.material.size());
  out.put(static_cast<std::uint64_t>(mesh.regions.size()));
  for (const auto& name : mesh.regions) out.putText(name);
  out.putArray(mesh.uvs.data(), mesh.uvs.size());
  out.putArray(mesh.normals.data(), mesh.normals.size());
  const Textures textures = texturesOf(mesh);
  out.put(static_cast<std::uint64_t>(textures.all.size()));
  for (const auto& texture : textures.all) {
    for (const std::string* text : {&texture->name, &texture->mime_type, &texture->bytes}) out.putText(*text);
    for (const sim::Texture::Wrap wrap : texture->wrap) out.put(static_cast<std::uint32_t>(wrap));
  }
  out.put(static_cast<std::uint64_t>(mesh.materials.size()));
  for (std::size_t m = 0; m < mesh.materials.size(); ++m)
    put(out, mesh.materials[m], textures.of_material[m]);
  out.put(static_cast<std::uint64_t>(mesh.degenerate_dropped));
  out.put(static_cast<std::uint64_t>(sources.files.size()));
  for (const auto& file : sources.files) {
    out.putText(file.name);
    out.putText(file.kind);
    out.put(file.hash);
  }
  out.put(static_cast<std::uint64_t>(sources.warnings.size()));
  for (const auto& warning : sources.warnings) {
    out.put(warning.line);
    out.put(warning.column);
    out.putText(warning.text);
  }
  return out.take();
}

sim::Mesh unpackMesh(std::string_view bytes, MeshSources& sources) {
  Unpacker in(bytes);
  sim::Mesh mesh;
  mesh.name = in.getText();
  mesh.vertices_m = in.getArray<sim::Vec3>();
  mesh.triangles = in.getArray<std::array<std::uint32_t, 3>>();
  mesh.region = in.getArray<std::uint32_t>();
  mesh.material = in.getArray<std::uint32_t>();
  mesh.regions.resize(in.getCount(sizeof(std::uint64_t)));
  for (auto& name : mesh.regions) name = in.getText();
  mesh.uvs = in.getArray<glm::vec2>();
  mesh.normals = in.getArray<sim::Vec3f>();
  std::vector<std::shared_ptr<const sim::Texture>> textures(in.getCount(3 * sizeof(std::uint64_t)));
  std::size_t texture_bytes = 0;
  for (auto& texture : textures) {
    texture = getTexture(in);
    texture_bytes += texture->bytes.size();
  }
  if (texture_bytes > kMostTextureBytes) throw std::runtime_error("its pictures are too large");
  mesh.materials.resize(in.getCount(sizeof(std::uint64_t) + sizeof(sim::Colour)));
  for (auto& material : mesh.materials) material = getMaterial(in, textures);
  mesh.degenerate_dropped = static_cast<std::size_t>(in.get<std::uint64_t>());
  sources.files.resize(in.getCount(3 * sizeof(std::uint64_t)));
  for (auto& file : sources.files) {
    file.name = in.getText();
    file.kind = in.getText();
    file.hash = in.get<std::uint64_t>();
  }
  sources.warnings.resize(in.getCount(2 * sizeof(int) + sizeof(std::uint64_t)));
  for (auto& warning : sources.warnings) {
    warning.line = in.get<int>();
    warning.column = in.get<int>();
    warning.text = in.getText();
  }
  in.requireEnd();
  if (mesh.region.size() != mesh.triangles.size() || mesh.material.size() != mesh.triangles.size()) {
    throw std::runtime_error("not every triangle has a region and a material");
  }
  requireBelow(mesh.region, mesh.regions.size());
  requireBelow(mesh.material, mesh.materials.size());
  requireLooks(mesh);
  return mesh;
}

}  // namespace espalier::scenes
