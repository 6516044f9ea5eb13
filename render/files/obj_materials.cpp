#include "render/files/obj_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "render/image/tone.h"
#include "sim/base/hasher.h"

namespace espalier::render {

std::string objName(const std::string& name) {
  std::string word = name.empty() ? "unnamed" : name;
  for (char& c : word) {
    if (static_cast<unsigned char>(c) <= ' ' || c == '#' || c == '\\') c = '_';
  }
  return word;
}

namespace {

std::array<float, 3> numbersOf(const sim::Colour& colour) {
  return {colour.r, colour.g, colour.b};
}

}  // namespace

const std::string& ObjMaterials::nameOf(const sim::Material& material) {
  Look look{material.colour,  material.alpha, material.alpha_mode == sim::Material::Alpha::mask, {}, {},
            material.emissive};
  if (material.alpha_mode == sim::Material::Alpha::opaque) look.alpha = 1.0f;
  if (material.texture != nullptr) {
    look.picture = material.texture->bytes;
    look.mime_type = material.texture->mime_type;
  }
  return nameOf(material.name, look);
}

const std::string& ObjMaterials::nameOf(const std::string& kind, const ModelMesh& mesh) {
  if (mesh.picture == nullptr)
    return nameOf(kind, Look{mesh.base_colour, mesh.alpha, false, {}, {}, mesh.emits});
  return nameOf(kind, Look{sim::Colour(1.0f), mesh.alpha, !mesh.picture->tiles, mesh.picture->png,
                           "image/png", mesh.emits});
}

const std::string& ObjMaterials::nameOf(const std::string& wish, const Look& look) {
  const std::string picture = look.picture.empty() ? "" : pictureFile(look);
  const auto [known, is_new] = names_.try_emplace(
      {wish, numbersOf(look.colour), look.alpha, look.cut_out, picture, numbersOf(look.emits)}, "");
  if (!is_new) return known->second;
  std::string name = objName(wish);
  for (int number = 2; !taken_.insert(name).second; ++number)
    name = fmt::format("{}_{}", objName(wish), number);
  known->second = name;
  if (!keep_) return known->second;
  const auto shown = [](const sim::Colour& linear) { return srgbFromLinear(glm::clamp(linear, 0.0f, 1.0f)); };
  const sim::Colour colour = shown(look.colour);
  auto out = std::back_inserter(library_.mtl);
  fmt::format_to(out, "\nnewmtl {}\nKd {:.5f} {:.5f} {:.5f}\nKs 0 0 0\nillum 1\nd {:.4g}\n", name, colour.r,
                 colour.g, colour.b, look.alpha);
  if (look.emits != sim::Colour(0.0f)) {
    const sim::Colour emits = shown(look.emits);
    fmt::format_to(out, "Ke {:.5f} {:.5f} {:.5f}\n", emits.r, emits.g, emits.b);
  }
  if (!picture.empty()) fmt::format_to(out, "map_Kd {}\n", picture);
  if (!picture.empty() && look.cut_out) fmt::format_to(out, "map_d -imfchan m {}\n", picture);
  return known->second;
}

std::string ObjMaterials::pictureFile(const Look& look) {
  const auto [known, is_new] = files_.try_emplace({sim::hashOf(look.picture), look.picture.size()}, "");
  if (!is_new) return known->second;
  known->second =
      fmt::format("{}_{}.{}", stem_, files_.size(), look.mime_type == "image/jpeg" ? "jpg" : "png");
  if (keep_) library_.pictures.push_back({known->second, std::string(look.picture)});
  return known->second;
}

}  // namespace espalier::render
