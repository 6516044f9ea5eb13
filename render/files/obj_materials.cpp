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

const std::string& ObjMaterials::nameOf(const sim::Material& material) {
  Look look{material.colour, material.alpha, material.alpha_mode == sim::Material::Alpha::mask, {}, {}};
  if (material.alpha_mode == sim::Material::Alpha::opaque) look.alpha = 1.0f;
  if (material.texture != nullptr) {
    look.picture = material.texture->bytes;
    look.mime_type = material.texture->mime_type;
  }
  return nameOf(material.name, look);
}

const std::string& ObjMaterials::nameOf(const std::string& kind, const ModelMesh& mesh) {
  if (mesh.picture == nullptr) return nameOf(kind, Look{mesh.base_colour, 1.0f, false, {}, {}});
  return nameOf(kind, Look{sim::Colour(1.0f), 1.0f, !mesh.picture->tiles, mesh.picture->png, "image/png"});
}

const std::string& ObjMaterials::nameOf(const std::string& wish, const Look& look) {
  const std::string picture = look.picture.empty() ? "" : pictureFile(look);
  const auto [known, is_new] = names_.try_emplace(
      {wish, look.colour.r, look.colour.g, look.colour.b, look.alpha, look.cut_out, picture}, "");
  if (!is_new) return known->second;
  std::string name = objName(wish);
  for (int number = 2; !taken_.insert(name).second; ++number)
    name = fmt::format("{}_{}", objName(wish), number);
  known->second = name;
  if (!keep_) return known->second;
  const sim::Colour shown = srgbFromLinear(glm::clamp(look.colour, 0.0f, 1.0f));
  auto out = std::back_inserter(library_.mtl);
  fmt::format_to(out, "\nnewmtl {}\nKd {:.5f} {:.5f} {:.5f}\nKs 0 0 0\nillum 1\nd {:.4g}\n", name, shown.r,
                 shown.g, shown.b, look.alpha);
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
