#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace espalier::studio {

/// Files that frames name, by their IDs: the site's model, and pictures. Any thread may call any of it.
class Assets {
 public:
  using Bytes = std::shared_ptr<const std::string>;

  void setSite(std::string id, std::string glb) {
    const std::lock_guard lock(mutex_);
    site_ = {std::move(id), std::make_shared<const std::string>(std::move(glb))};
  }
  /// In place of those before; of these a page may still want one, so they stay for a turn.
  void setTextures(std::map<std::string, std::string> textures) {
    const std::lock_guard lock(mutex_);
    before_ = std::move(textures_);
    textures_.clear();
    for (auto& [id, png] : textures) textures_[id] = std::make_shared<const std::string>(std::move(png));
  }
  /// Null where there is none of that ID.
  Bytes site(const std::string& id) const {
    const std::lock_guard lock(mutex_);
    return site_.first == id ? site_.second : nullptr;
  }
  Bytes texture(const std::string& id) const {
    const std::lock_guard lock(mutex_);
    for (const auto* textures : {&textures_, &before_}) {
      if (const auto at = textures->find(id); at != textures->end()) return at->second;
    }
    return nullptr;
  }

 private:
  mutable std::mutex mutex_;
  std::pair<std::string, Bytes> site_;
  std::map<std::string, Bytes> textures_, before_;
};

}  // namespace espalier::studio
