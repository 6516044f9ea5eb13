#include "scenes/product.h"

#include <fmt/format.h>

#include "scenes/scene.h"
#include "sim/base/error.h"

namespace espalier::scenes {

std::string_view nameOf(ProductKind kind) {
  switch (kind) {
    case ProductKind::mesh:
      return "mesh";
    case ProductKind::picture:
      return "picture";
    case ProductKind::skeleton:
      break;
  }
  return "skeleton";
}

std::vector<Product> productsOf(const Scene& scene) {
  std::vector<Product> made;
  if (!scene.plants.empty()) {
    made.push_back({"plant", ProductKind::mesh, kPlantFile});
    made.push_back({"skeleton", ProductKind::skeleton, kSkeletonFile});
  }
  for (const PiecesSpec& pieces : scene.pieces)
    made.push_back({pieces.name, ProductKind::mesh, pieces.name + ".glb"});
  for (const HeightsSpec& heights : scene.heights) {
    made.push_back({heights.name, ProductKind::mesh, heights.name + ".glb"});
    made.push_back({heights.name, ProductKind::picture, heights.name + ".exr"});
  }
  for (const ImageSpec& image : scene.images)
    made.push_back({image.name, ProductKind::picture, image.name + ".png"});
  return made;
}

const Product& productAsked(const ProductAsk& ask, const std::vector<Product>& made) {
  std::vector<std::string> names;
  const Product* found = nullptr;
  for (const Product& product : made) {
    if (product.kind != ask.kind) continue;
    names.push_back(product.name);
    if (product.name == ask.product || ask.product.empty()) found = &product;
  }
  if (found && (!ask.product.empty() || names.size() == 1)) return *found;
  const std::string scene = ask.scene.string();
  if (names.empty()) {
    throw sim::InputError(
        fmt::format("the scene {} makes no {}; expected one that does", scene, nameOf(ask.kind)));
  }
  if (ask.product.empty()) {
    throw sim::InputError(fmt::format("the scene {} makes more than one {}; expected product: with one of {}",
                                      scene, nameOf(ask.kind), listed(names)));
  }
  throw sim::InputError(fmt::format("the scene {} makes no {} {}; expected one of {}{}", scene,
                                    nameOf(ask.kind), inQuotes(ask.product), listed(names, ask.product),
                                    didYouMean(ask.product, names)));
}

}  // namespace espalier::scenes
