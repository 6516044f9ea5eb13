#pragma once
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/whole_file.h"

/// .glb files as another program reads them.
namespace espalier::tests {

/// With the indices of compressed primitives in their extras: Debian's tinygltf refuses accessors of indices
/// that have no data of their own.
inline std::string withPackedIndicesAside(std::string glb) {
  constexpr std::size_t kHeaders = 20;
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, glb.data() + at, sizeof value);
    return value;
  };
  const std::size_t length = word(12);
  auto json = nlohmann::json::parse(glb.substr(kHeaders, length));
  if (!json.contains("meshes")) return glb;
  for (auto& mesh : json["meshes"]) {
    for (auto& primitive : mesh["primitives"]) {
      if (!primitive.contains("extensions")) continue;
      primitive["extras"]["indices"] = primitive["indices"];
      primitive.erase("indices");
    }
  }
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  glb.replace(kHeaders, length, text);
  for (const auto& [at, value] :
       {std::pair{std::size_t{8}, glb.size()}, std::pair{std::size_t{12}, text.size()}}) {
    const auto number = static_cast<std::uint32_t>(value);
    std::memcpy(glb.data() + at, &number, sizeof number);
  }
  return glb;
}

inline tinygltf::Model readGlb(const std::string& glb) {
  const std::string bytes = withPackedIndicesAside(glb);
  tinygltf::Model model;
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(  // bytes are all that is looked at
      [](tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
         void*) { return true; },
      nullptr);
  std::string error, warning;
  EXPECT_TRUE(reader.LoadBinaryFromMemory(&model, &error, &warning,
                                          reinterpret_cast<const unsigned char*>(bytes.data()),
                                          static_cast<unsigned>(bytes.size())))
      << error;
  EXPECT_EQ(error, "");
  EXPECT_EQ(warning, "");
  return model;
}

template <class T>
const T& at(const std::vector<T>& list, int index) {
  return list[static_cast<std::size_t>(index)];
}

inline std::string bytesOfView(const tinygltf::Model& model, int view) {
  const auto& about = at(model.bufferViews, view);
  const auto* data = model.buffers[0].data.data() + about.byteOffset;
  return {reinterpret_cast<const char*>(data), about.byteLength};
}

/// What an accessor holds, as it lies there: more than that may lie in its view.
template <class T>
std::vector<T> valuesOf(const tinygltf::Model& model, int accessor) {
  const auto& about = at(model.accessors, accessor);
  const std::string bytes = bytesOfView(model, about.bufferView);
  const auto stride = static_cast<std::size_t>(about.ByteStride(at(model.bufferViews, about.bufferView)));
  EXPECT_EQ(stride % sizeof(T), 0u);
  std::vector<T> values(about.count * stride / sizeof(T));
  EXPECT_LE(values.size() * sizeof(T), bytes.size());
  std::memcpy(values.data(), bytes.data(), std::min(bytes.size(), values.size() * sizeof(T)));
  return values;
}

inline const tinygltf::Node& nodeNamed(const tinygltf::Model& model, const std::string& name) {
  for (const auto& node : model.nodes)
    if (node.name == name) return node;
  ADD_FAILURE() << "there is no node " << name;
  return model.nodes.at(0);
}
inline const tinygltf::Primitive& primitiveOf(const tinygltf::Model& model, const std::string& node) {
  return at(model.meshes, nodeNamed(model, node).mesh).primitives.at(0);
}

/// The Khronos validator's exit status (tests/render/files/validate_glb.cjs); 77 where it or node is missing.
inline int khronosStatus(const std::string& glb) {
  if (std::system("node --version >/dev/null 2>&1") != 0) return 77;
  const char* modules = std::getenv("ESPALIER_NODE_MODULES");
  const std::string node_path =
      modules ? modules : std::string(ESPALIER_SOURCE_DIR) + "/build/node/node_modules";
  const auto file = std::filesystem::path(testing::TempDir()) /
                    ("espalier_" + std::to_string(std::hash<std::string>()(glb)) + ".glb");
  sim::writeWhole(file, glb);
  const std::string command = "NODE_PATH='" + node_path +
                              "' node '" ESPALIER_SOURCE_DIR "/tests/render/files/validate_glb.cjs' '" +
                              file.string() + "'";
  const int status = WEXITSTATUS(std::system(command.c_str()));
  std::filesystem::remove(file);
  return status;
}

}  // namespace espalier::tests
