#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scenes/problem.h"
#include "scenes/product.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// Scenes that are read because others ask them for products: each once, and none for its own product,
/// however long the way around.
class AskedScenes {
 public:
  using Read = std::function<Result<Scene>(const std::filesystem::path& path, AskedScenes& asked)>;
  explicit AskedScenes(Read read) : read_(std::move(read)) {}

  /// While it lives, the scene of a file is being read.
  class Open {
   public:
    Open(AskedScenes& asked, const std::filesystem::path& path);
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;
    ~Open() { asked_.open_.pop_back(); }

   private:
    AskedScenes& asked_;
  };

  /// Adds what is wrong with the asks, and with the scenes that they ask.
  void require(std::span<const ProductAsk> asks, Problems& problems);

 private:
  /// Of its products; null where it is no good, which was said.
  const std::vector<Product>* productsIn(const ProductAsk& ask, Problems& problems);

  Read read_;
  std::vector<std::pair<std::filesystem::path, std::string>> open_;  // canonical and shown paths
  struct Known {
    bool good = false;
    std::vector<Product> products;
  };
  std::map<std::filesystem::path, Known> known_;  // by canonical path
};

}  // namespace espalier::scenes
