// What Assimp hands over, made by hand from the bytes: any names, numbers, faces, nodes and materials.
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <array>
#include <cstring>
#include <memory>

#include "scenes/import/assimp_reader.h"
#include "scenes/import/assimp_scene.h"
#include "scenes/import/mesh_import.h"
#include "scenes/import/mesh_wire.h"
#include "sim/base/error.h"
#include "tests/fuzz/target.h"

namespace espalier::fuzz {
namespace {

/// Takes numbers from the front of the bytes; zeros where they are at their end.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T take() {
    T value{};
    const std::size_t there = std::min(sizeof value, bytes_.size());
    std::memcpy(&value, bytes_.data(), there);
    bytes_.remove_prefix(there);
    return value;
  }
  unsigned below(unsigned end) { return take<std::uint8_t>() % end; }
  aiString name() {
    constexpr std::array kMadeUp{"",       "defaultobject", "DefaultMaterial", "nodes[3]", "<STL_BINARY>",
                                 "wall-0", "\xff\x01 x"};
    const unsigned which = below(12);
    if (which < kMadeUp.size()) return aiString(kMadeUp[which]);
    const auto size = std::min<std::size_t>(below(20), bytes_.size());
    aiString name{std::string(bytes_.substr(0, size))};
    bytes_.remove_prefix(size);
    if (which == 11) name.length = take<std::uint32_t>();  // as long as it says, or not
    return name;
  }

 private:
  std::string_view bytes_;
};

/// A number as files have it, or any at all.
float coordinate(Bytes& bytes) {
  const auto whole = bytes.take<std::int8_t>();
  return whole == 127 ? bytes.take<float>() : static_cast<float>(whole) / 8.0f;
}

/// An array as Assimp's structs own it.
template <class T>
T** arrayOf(std::vector<std::unique_ptr<T>> made, unsigned& count) {
  count = static_cast<unsigned>(made.size());
  T** const array = new T*[made.size()];
  for (std::size_t i = 0; i < made.size(); ++i) array[i] = made[i].release();
  return array;
}

std::unique_ptr<aiMesh> mesh(Bytes& bytes) {
  auto mesh = std::make_unique<aiMesh>();
  mesh->mName = bytes.name();
  mesh->mMaterialIndex = bytes.below(4);
  mesh->mNumVertices = bytes.below(24);
  mesh->mVertices = new aiVector3D[mesh->mNumVertices];
  for (unsigned v = 0; v < mesh->mNumVertices; ++v) {
    const float x = coordinate(bytes), y = coordinate(bytes);
    mesh->mVertices[v] = {x, y, coordinate(bytes)};
  }
  mesh->mNumFaces = bytes.below(16);
  mesh->mFaces = new aiFace[mesh->mNumFaces];
  for (unsigned f = 0; f < mesh->mNumFaces; ++f) {
    aiFace& face = mesh->mFaces[f];
    face.mNumIndices = bytes.below(12);
    face.mIndices = new unsigned[face.mNumIndices];
    for (unsigned c = 0; c < face.mNumIndices; ++c) {
      const unsigned index = bytes.below(64);
      face.mIndices[c] = index == 63 ? bytes.take<std::uint32_t>() : index;
    }
  }
  return mesh;
}

std::unique_ptr<aiMaterial> material(Bytes& bytes) {
  auto material = std::make_unique<aiMaterial>();
  if (bytes.below(4) > 0) {
    const aiString name = bytes.name();
    material->AddProperty(&name, AI_MATKEY_NAME);
  }
  for (int kind = 0; kind < 2; ++kind) {
    if (bytes.below(3) == 0) continue;
    const float r = coordinate(bytes), g = coordinate(bytes), b = coordinate(bytes);
    const aiColor4D colour(r, g, b, 1.0f);
    if (kind == 0) material->AddProperty(&colour, 1, AI_MATKEY_COLOR_DIFFUSE);
    if (kind == 1) material->AddProperty(&colour, 1, AI_MATKEY_BASE_COLOR);
  }
  return material;
}

std::unique_ptr<aiNode> node(Bytes& bytes, int depth) {
  auto node = std::make_unique<aiNode>();
  node->mName = bytes.name();
  if (bytes.below(3) == 0) {
    for (unsigned row = 0; row < 4; ++row) {
      for (unsigned column = 0; column < 4; ++column) node->mTransformation[row][column] = coordinate(bytes);
    }
  }
  node->mNumMeshes = bytes.below(4);
  node->mMeshes = new unsigned[node->mNumMeshes];
  for (unsigned m = 0; m < node->mNumMeshes; ++m) node->mMeshes[m] = bytes.below(4);
  std::vector<std::unique_ptr<aiNode>> children;
  for (unsigned c = depth < 4 ? bytes.below(4) : 0; c > 0; --c)
    children.push_back(fuzz::node(bytes, depth + 1));
  node->mChildren = arrayOf(std::move(children), node->mNumChildren);
  return node;
}

std::unique_ptr<aiScene> scene(Bytes& bytes) {
  auto scene = std::make_unique<aiScene>();
  std::vector<std::unique_ptr<aiMesh>> meshes;
  for (unsigned m = bytes.below(4); m > 0; --m) meshes.push_back(mesh(bytes));
  scene->mMeshes = arrayOf(std::move(meshes), scene->mNumMeshes);
  std::vector<std::unique_ptr<aiMaterial>> materials;
  for (unsigned m = bytes.below(4); m > 0; --m) materials.push_back(material(bytes));
  scene->mMaterials = arrayOf(std::move(materials), scene->mNumMaterials);
  scene->mRootNode = node(bytes, 0).release();
  return scene;
}

}  // namespace

std::vector<std::string> seeds() {
  // Two meshes of a triangle and a quad, two materials, a root with two children.
  std::string good;
  const auto triangle = [&](char corners) {
    good += std::string("\x0a\x04wall", 6) + '\x00' + corners +
            std::string("\x00\x00\x00\x08\x00\x00\x08\x08\x00", 9);
    if (corners == 4) good += std::string("\x00\x08\x00", 3);
    good += std::string("\x01", 1) + corners + std::string("\x00\x01\x02", 3) + (corners == 4 ? "\x03" : "");
  };
  good += '\x02';
  triangle(3);
  triangle(4);
  good += std::string("\x02\x01\x0a\x03red\x01\x08\x00\x00\x01\x00\x08\x00", 13);
  good += std::string("\x01\x0a\x04\x67rey\x01\x04\x04\x04\x00", 12);
  good += std::string("\x00\x01\x01\x00\x02", 5);
  good += std::string("\x0a\x05upper\x01\x01\x01\x00", 11) + std::string("\x00\x01\x02\x00\x01\x00", 6);
  std::string long_one = good;
  for (int i = 0; i < 40; ++i) long_one += static_cast<char>(37 * i);
  return {good, long_one, std::string(64, '\x05'), std::string(200, '\x0b')};
}

}  // namespace espalier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace espalier;
  fuzz::Bytes bytes(fuzz::textOf(data, size));
  constexpr std::array kColours{scenes::MeshColours::display, scenes::MeshColours::linear,
                                scenes::MeshColours::none};
  const auto colours = kColours[bytes.below(3)];
  const auto regions = bytes.below(2) == 0 ? scenes::RegionsFrom::group : scenes::RegionsFrom::material;
  const auto scene = fuzz::scene(bytes);
  try {
    scenes::requireSound(*scene);
    scenes::MeshSources read;
    scenes::meshFromChild(
        scenes::packMesh(scenes::meshOf(scenes::instancesOf(*scene),
                                        scenes::materialsOf(*scene, "m", colours), regions, "m")),
        read);
  } catch (const sim::InputError&) {
  }
  return 0;
}
