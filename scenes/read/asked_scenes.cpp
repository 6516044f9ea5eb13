#include "scenes/read/asked_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <system_error>

#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;

/// A chain of scenes, each made from the next, may be so long.
constexpr std::size_t kMostInARow = 32;

fs::path sameForAll(const fs::path& path) {
  std::error_code error;
  fs::path canonical = fs::weakly_canonical(path, error);
  return error ? path : canonical;
}

}  // namespace

AskedScenes::Open::Open(AskedScenes& asked, const fs::path& path) : asked_(asked) {
  asked_.open_.emplace_back(sameForAll(path), path.string());
}

void AskedScenes::require(std::span<const ProductAsk> asks, Problems& problems) {
  for (const ProductAsk& ask : asks) {
    const std::vector<Product>* const products = productsIn(ask, problems);
    if (!products) continue;
    try {
      productAsked(ask, *products);
    } catch (const sim::InputError& error) {
      problems.add(ask.place, error.what());
    }
  }
}

const std::vector<Product>* AskedScenes::productsIn(const ProductAsk& ask, Problems& problems) {
  const fs::path path = sameForAll(ask.scene);
  const auto same = [&](const auto& file) { return file.first == path; };
  if (const auto start = std::find_if(open_.begin(), open_.end(), same); start != open_.end()) {
    std::string chain;
    for (auto file = start; file != open_.end(); ++file) chain += file->second + " -> ";
    problems.add(ask.place,
                 fmt::format("scenes that feed each other in a circle: {}{}; expected one of them to "
                             "do without the other's product",
                             chain, ask.scene.string()));
    return nullptr;
  }
  const auto [at, is_new] = known_.try_emplace(path);
  if (!is_new) return at->second.good ? &at->second.products : nullptr;
  std::error_code error;
  if (!fs::is_regular_file(ask.scene, error)) {
    problems.add(ask.place, fmt::format("there is no scene file {}; expected one", ask.scene.string()));
    return nullptr;
  }
  if (open_.size() >= kMostInARow) {
    problems.add(
        ask.place,
        fmt::format("more than {} scenes in a row, each made from the next; expected fewer", kMostInARow));
    return nullptr;
  }
  const Result<Scene> scene = read_(ask.scene, *this);
  for (const Problem& problem : scene.problems())
    problems.add({std::make_shared<const std::string>(problem.path), problem.line, problem.column,
                  problem.end_column, problem.key},
                 problem.text);
  if (!scene) return nullptr;
  Known& known = known_.at(path);
  known = {true, productsOf(*scene)};
  return &known.products;
}

}  // namespace espalier::scenes
