#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/problem.h"

/// What a run of a scene leaves that another scene can take as its input.
namespace espalier::scenes {

struct Scene;

enum class ProductKind { mesh, picture, skeleton };

/// What messages call one: "mesh".
std::string_view nameOf(ProductKind kind);

/// A file in the output folder of a scene's run.
struct Product {
  std::string name;
  ProductKind kind = ProductKind::mesh;
  std::string file;
};

/// Files of every run that has plants.
inline constexpr const char *kPlantFile = "plant.glb", *kSkeletonFile = "skeleton.json";

/// All that a scene makes: its plants with the meshes that they grew on as the mesh "plant", their skeletons
/// as "skeleton", and its pieces and images by their names.
std::vector<Product> productsOf(const Scene& scene);

/// A scene's wish for another's product.
struct ProductAsk {
  std::filesystem::path scene;  ///< the other's file
  std::string product;          ///< empty: its only one of that kind
  ProductKind kind = ProductKind::mesh;
  Place place = {};  ///< where it is asked for
};

/// The product that is asked for, of those that a scene makes. Throws sim::InputError, with what there is,
/// where it is not among them.
const Product& productAsked(const ProductAsk& ask, const std::vector<Product>& made);

}  // namespace espalier::scenes
