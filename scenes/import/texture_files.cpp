#include "scenes/import/texture_files.h"

#include <fmt/format.h>

#include "scenes/clean_text.h"
#include "sim/base/counted.h"
#include "sim/base/hasher.h"

namespace espalier::scenes {

std::string mimeTypeOf(std::string_view picture) {
  if (picture.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
  if (picture.starts_with("\xff\xd8\xff")) return "image/jpeg";
  return {};
}

std::shared_ptr<const sim::Texture> TextureFiles::add(const std::string& name, std::string_view bytes,
                                                      const Wraps& wrap) {
  const std::tuple key(sim::hashOf(bytes), bytes.size(), wrap);
  const auto known = textures_.find(key);
  if (known != textures_.end()) return known->second;
  std::string mime_type = mimeTypeOf(bytes);
  if (mime_type.empty()) {
    miss(name, "is no PNG or JPEG file");
    return nullptr;
  }
  if (bytes.size() > kMostTextureBytes - bytes_) {
    miss(name, fmt::format("is too large: pictures may have {} MB together", kMostTextureBytes >> 20));
    return nullptr;
  }
  bytes_ += bytes.size();
  return textures_[key] = std::make_shared<sim::Texture>(
             sim::Texture{cleanText(name), std::move(mime_type), std::string(bytes), wrap});
}

void TextureFiles::miss(const std::string& name, const std::string& why) {
  if (missing_.empty()) {
    first_ = name;
    why_ = why;
  }
  missing_.insert(name);
}

void TextureFiles::warn(std::vector<Problem>& warnings) const {
  if (missing_.empty()) return;
  std::string text = fmt::format("the picture {} of its materials {}", inQuotes(first_), why_);
  if (missing_.size() > 1)
    text += fmt::format("; {} left out too", sim::counted(missing_.size() - 1, "more is", "more are"));
  warnings.push_back({{}, 0, 0, text + "; such materials have their colour alone"});
}

}  // namespace espalier::scenes
