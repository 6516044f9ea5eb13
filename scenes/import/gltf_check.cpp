#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/import/mesh_checks.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMostNodes = 1'000'000;

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// The JSON chunk of a GLB file (glTF 2.0, section 4.4: three words of header, then chunks of length, type,
/// data).
std::string_view jsonOf(std::string_view glb) {
  if (glb.size() < 20) throw sim::InputError("the file is cut: a GLB file has at least 20 bytes");
  if (wordAt(glb, 8) != glb.size()) {
    throw sim::InputError(fmt::format("the file is damaged or cut: its header promises {} bytes, it has {}",
                                      wordAt(glb, 8), glb.size()));
  }
  const std::size_t length = wordAt(glb, 12);
  if (glb.substr(16, 4) != "JSON" || length > glb.size() - 20) {
    throw sim::InputError("the file is damaged: its first chunk is not whole JSON");
  }
  return glb.substr(20, length);
}

const json& entry(const json& document, const char* list, const json& index) {
  const auto i = index.get<std::uint64_t>();
  if (i >= document.at(list).size()) throw sim::InputError(fmt::format("{} {} does not exist", list, i));
  return document.at(list)[i];
}

std::uint64_t trianglesOf(const json& document, const json& primitive) {
  const int mode = primitive.value("mode", 4);
  if (mode < 4) return 0;
  const json& accessor =
      primitive.contains("indices") ? primitive.at("indices") : primitive.at("attributes").at("POSITION");
  const auto corners = entry(document, "accessors", accessor).at("count").get<std::uint64_t>();
  if (mode == 4) return corners / 3;
  return corners < 3 ? 0 : corners - 2;
}

std::uint64_t trianglesIn(const json& document) {
  if (!document.contains("scenes") || document.at("scenes").empty()) {
    throw sim::InputError("the glTF file has no scene, so no mesh in it is placed anywhere");
  }
  std::vector<json> open =
      entry(document, "scenes", document.value("scene", json(0U))).value("nodes", json::array());
  std::uint64_t triangles = 0;
  for (std::uint64_t visited = 0; !open.empty(); ++visited) {
    if (visited > kMostNodes)
      throw sim::InputError("the glTF file's nodes form a circle or are shared too often");
    const json node = entry(document, "nodes", open.back());
    open.pop_back();
    if (node.contains("mesh")) {
      for (const json& primitive : entry(document, "meshes", node.at("mesh")).at("primitives")) {
        triangles += trianglesOf(document, primitive);
      }
    }
    for (const json& child : node.value("children", json::array())) open.push_back(child);
  }
  return triangles;
}

}  // namespace

DeclaredCounts checkGltf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  try {
    const json document = json::parse(bytes.starts_with("glTF") ? jsonOf(bytes) : std::string_view(bytes));
    const std::string version = document.at("asset").at("version").get<std::string>();
    if (!version.starts_with("2.")) throw sim::InputError(fmt::format("glTF {} is not glTF 2", version));
    return {std::nullopt, trianglesIn(document)};
  } catch (const json::exception& error) {
    throw sim::InputError(fmt::format("the glTF file's JSON is not as it should be: {}", error.what()));
  }
}

}  // namespace espalier::scenes
