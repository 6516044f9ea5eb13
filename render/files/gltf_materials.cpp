#include "render/files/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "sim/base/hasher.h"

namespace espalier::render {
namespace {

int wrapMode(sim::Texture::Wrap wrap) {
  switch (wrap) {
    case sim::Texture::Wrap::clamp:
      return TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    case sim::Texture::Wrap::mirror:
      return TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT;
    default:
      return TINYGLTF_TEXTURE_WRAP_REPEAT;
  }
}

const char* nameOf(sim::Material::Alpha mode) {
  return mode == sim::Material::Alpha::mask ? "MASK" : "BLEND";
}

/// 0 to 1, as the shortest number that is this float.
double factorOf(float value) {
  const std::string text = fmt::format("{}", std::clamp(value, 0.0f, 1.0f));
  double number = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace

int GltfMaterials::of(const sim::Material& material, int texture) {
  const std::array<float, 10> numbers{material.colour.r,    material.colour.g,   material.colour.b,
                                      material.alpha,       material.roughness,  material.metallic,
                                      material.emissive.r,  material.emissive.g, material.emissive.b,
                                      material.alpha_cutoff};
  const Key key{material.name, numbers, material.alpha_mode, material.double_sided, texture};
  const auto [found, added] = materials_.try_emplace(key, sizeOf(file_.model().materials));
  if (!added) return found->second;
  tinygltf::Material result;
  result.name = validUtf8(material.name);
  auto& looks = result.pbrMetallicRoughness;
  looks.baseColorFactor = {factorOf(material.colour.r), factorOf(material.colour.g),
                           factorOf(material.colour.b), factorOf(material.alpha)};
  looks.baseColorTexture.index = texture;
  looks.metallicFactor = factorOf(material.metallic);
  looks.roughnessFactor = factorOf(material.roughness);
  if (material.emissive != sim::Colour(0.0f)) {
    const sim::Colour emissive = material.emissive;
    const float strength = std::max({1.0f, emissive.r, emissive.g, emissive.b});
    result.emissiveFactor = {factorOf(emissive.r / strength), factorOf(emissive.g / strength),
                             factorOf(emissive.b / strength)};
    if (strength > 1.0f) {
      constexpr const char* kStrength = "KHR_materials_emissive_strength";
      result.extensions[kStrength] =
          tinygltf::Value(tinygltf::Value::Object{{"emissiveStrength", tinygltf::Value(double{strength})}});
      file_.use(kStrength);
    }
  }
  if (material.alpha_mode != sim::Material::Alpha::opaque) result.alphaMode = nameOf(material.alpha_mode);
  if (material.alpha_mode == sim::Material::Alpha::mask) result.alphaCutoff = factorOf(material.alpha_cutoff);
  result.doubleSided = material.double_sided;
  file_.model().materials.push_back(std::move(result));
  return found->second;
}

int GltfMaterials::textureOf(const std::string& name, std::string_view bytes, const std::string& mime_type,
                             const Wraps& wrap) {
  const int image = imageOf(name, bytes, mime_type), sampler = samplerOf(wrap);
  const auto [found, added] = textures_.try_emplace({image, sampler}, sizeOf(file_.model().textures));
  if (added) {
    tinygltf::Texture texture;
    texture.source = image;
    texture.sampler = sampler;
    file_.model().textures.push_back(std::move(texture));
  }
  return found->second;
}

int GltfMaterials::imageOf(const std::string& name, std::string_view bytes, const std::string& mime_type) {
  const auto [found, added] =
      images_.try_emplace({sim::hashOf(bytes), bytes.size()}, sizeOf(file_.model().images));
  if (added) {
    tinygltf::Image image;
    image.name = validUtf8(name);
    image.mimeType = mime_type;
    image.bufferView = file_.bytes(bytes);
    file_.model().images.push_back(std::move(image));
  }
  return found->second;
}

int GltfMaterials::samplerOf(const Wraps& wrap) {
  const auto [found, added] = samplers_.try_emplace(wrap, sizeOf(file_.model().samplers));
  if (added) {
    tinygltf::Sampler sampler;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.wrapS = wrapMode(wrap[0]);
    sampler.wrapT = wrapMode(wrap[1]);
    file_.model().samplers.push_back(std::move(sampler));
  }
  return found->second;
}

}  // namespace espalier::render
