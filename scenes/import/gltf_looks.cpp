#include "scenes/import/gltf_looks.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace espalier::scenes::gltf {
namespace {

/// A member that may be missing.
const Json& memberOf(const Json& object, const char* key) {
  static const Json kNone = Json::object();
  const auto member = object.find(key);
  return member == object.end() ? kNone : *member;
}

double numberIn(const Json& object, const char* key, double otherwise) {
  const auto member = object.find(key);
  if (member == object.end()) return otherwise;
  if (!member->is_number())
    throw sim::InputError(fmt::format("{} is {}; expected a number", key, shown(*member)));
  const double value = member->get<double>();
  if (!std::isfinite(value)) throw sim::InputError(fmt::format("{} is not a finite number", key));
  return value;
}

/// So many numbers.
std::vector<double> numbersIn(const Json& object, const char* key, std::vector<double> otherwise) {
  const auto member = object.find(key);
  if (member == object.end()) return otherwise;
  if (!member->is_array() || member->size() != otherwise.size() ||
      !std::all_of(member->begin(), member->end(), [](const Json& v) { return v.is_number(); })) {
    throw sim::InputError(fmt::format("{} is not an array of {} numbers", key, otherwise.size()));
  }
  for (std::size_t i = 0; i < otherwise.size(); ++i) {
    otherwise[i] = member->at(i).get<double>();
    if (!std::isfinite(otherwise[i])) throw sim::InputError(fmt::format("{} is not finite", key));
  }
  return otherwise;
}

float share(double value) {
  return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

sim::Texture::Wrap wrapIn(const Json& sampler, const char* key) {
  const std::uint64_t mode = wholeIn(sampler, key).value_or(10497);
  return mode == 33071   ? sim::Texture::Wrap::clamp
         : mode == 33648 ? sim::Texture::Wrap::mirror
                         : sim::Texture::Wrap::repeat;
}

class Reader {
 public:
  Reader(const Json& document, const Buffers& buffers, const FileBeside& file_beside, TextureFiles& textures)
      : document_(document), buffers_(buffers), file_beside_(file_beside), textures_(textures) {}

  Looks read(const Json& json) {
    Looks looks;
    sim::Material& material = looks.material;
    const auto name = json.find("name");
    if (name != json.end() && name->is_string()) material.name = *name;
    const Json& surface = memberOf(json, "pbrMetallicRoughness");
    const auto colour = numbersIn(surface, "baseColorFactor", {1, 1, 1, 1});
    material.colour = {share(colour[0]), share(colour[1]), share(colour[2])};
    material.alpha = share(colour[3]);
    material.roughness = share(numberIn(surface, "roughnessFactor", 1.0));
    material.metallic = share(numberIn(surface, "metallicFactor", 1.0));
    const auto emissive = numbersIn(json, "emissiveFactor", {0, 0, 0});
    material.emissive = {share(emissive[0]), share(emissive[1]), share(emissive[2])};
    const Json& stronger = memberOf(memberOf(json, "extensions"), "KHR_materials_emissive_strength");
    material.emissive *=
        static_cast<float>(std::clamp(numberIn(stronger, "emissiveStrength", 1.0), 0.0, 1000.0));
    // Such a texture is black but for a few lamps; without it all of the mesh would shine.
    if (json.contains("emissiveTexture") && material.emissive != sim::Colour(0.0f)) {
      material.emissive = sim::Colour(0.0f);
      textures_.miss("emissiveTexture", "is of a kind that is not read: what it shows sends out no light");
    }
    const std::string mode = json.contains("alphaMode") ? requiredText(json, "alphaMode") : "OPAQUE";
    using Alpha = sim::Material::Alpha;
    material.alpha_mode = mode == "MASK" ? Alpha::mask : mode == "BLEND" ? Alpha::blend : Alpha::opaque;
    material.alpha_cutoff = share(numberIn(json, "alphaCutoff", 0.5));
    const auto sides = json.find("doubleSided");
    material.double_sided = sides != json.end() && sides->is_boolean() && sides->get<bool>();
    if (surface.contains("baseColorTexture")) tryTexture(surface, looks);
    return looks;
  }

 private:
  /// A material is as good as it was without a texture that is broken.
  void tryTexture(const Json& surface, Looks& looks) {
    try {
      readTexture(requiredObject(surface, "baseColorTexture"), looks);
    } catch (const sim::InputError& error) {
      textures_.miss("baseColorTexture", fmt::format("cannot be read ({})", error.what()));
    }
  }

  void readTexture(const Json& info, Looks& looks) {
    looks.uv_set = static_cast<std::size_t>(wholeIn(info, "texCoord").value_or(0));
    const Json& transform = memberOf(memberOf(info, "extensions"), "KHR_texture_transform");
    if (!transform.empty()) {
      if (const auto set = wholeIn(transform, "texCoord")) looks.uv_set = static_cast<std::size_t>(*set);
      const auto offset = numbersIn(transform, "offset", {0, 0}),
                 scale = numbersIn(transform, "scale", {1, 1});
      const double turn = numberIn(transform, "rotation", 0.0), c = std::cos(turn), s = std::sin(turn);
      looks.uv_from_uv = glm::dmat3({1, 0, 0}, {0, 1, 0}, {offset[0], offset[1], 1}) *
                         glm::dmat3({c, -s, 0}, {s, c, 0}, {0, 0, 1}) *
                         glm::dmat3({scale[0], 0, 0}, {0, scale[1], 0}, {0, 0, 1});
    }
    const std::size_t number = requiredIndex(info, "index", document_, "textures");
    const Json& texture = document_["textures"][number];
    TextureFiles::Wraps wrap{};
    if (const auto sampler = indexIn(texture, "sampler", document_, "samplers")) {
      const Json& how = document_["samplers"][*sampler];
      wrap = {wrapIn(how, "wrapS"), wrapIn(how, "wrapT")};
    }
    const auto source = indexIn(texture, "source", document_, "images");
    if (!source) return textures_.miss(fmt::format("texture {}", number), "is in no format that is read");
    looks.material.texture = readImage(document_["images"][*source], *source, wrap);
  }

  std::shared_ptr<const sim::Texture> readImage(const Json& image, std::size_t number,
                                                const TextureFiles::Wraps& wrap) {
    std::string name = fmt::format("image {}", number);
    if (const auto given = image.find("name"); given != image.end() && given->is_string()) name = *given;
    if (const auto view = indexIn(image, "bufferView", document_, "bufferViews"))
      return textures_.add(name, bytesOf(*view), wrap);
    const std::string& uri = requiredText(image, "uri");
    if (uri.starts_with("data:")) {
      const auto bytes = decodedUri(uri);
      return textures_.add(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, wrap);
    }
    if (const std::string* const bytes = file_beside_(uri)) return textures_.add(uri, *bytes, wrap);
    textures_.miss(uri, "is not there as a regular file in the mesh's folder");
    return nullptr;
  }

  std::string_view bytesOf(std::size_t view) const {
    const Json& place = document_["bufferViews"][view];
    const std::string_view bytes = buffers_.of(requiredIndex(place, "buffer", document_, "buffers"));
    // Where it lies was looked at with the other views.
    return bytes.substr(static_cast<std::size_t>(wholeIn(place, "byteOffset").value_or(0)),
                        static_cast<std::size_t>(requiredWhole(place, "byteLength")));
  }

  const Json& document_;
  const Buffers& buffers_;
  const FileBeside& file_beside_;
  TextureFiles& textures_;
};

}  // namespace

std::vector<Looks> looksOf(const Json& document, const Buffers& buffers, const FileBeside& file_beside,
                           TextureFiles& textures) {
  Reader reader(document, buffers, file_beside, textures);
  std::vector<Looks> all;
  for (const Json& material : objectsIn(document, "materials"))
    inPart("material", all.size(), [&] { all.push_back(reader.read(material)); });
  return all;
}

}  // namespace espalier::scenes::gltf
