#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

/// Small mesh files for the tests of mesh import.
namespace espalier::tests {

/// A folder of its own for each test, gone afterwards.
class MeshFiles : public testing::Test {
 protected:
  MeshFiles() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        std::filesystem::temp_directory_path() / (std::string("espalier-") + test->test_suite_name() + "-" +
                                                  test->name() + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~MeshFiles() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    const auto path = folder_ / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

  std::filesystem::path folder_;
};

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline std::string readAll(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A unit square in the plane z = 0 as two groups of one triangle each, in two materials.
inline const std::string kSquareObj = R"(mtllib paint.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
g lower right
usemtl red
f 1 2 3
g upper
usemtl grey
f 1 3 4
)";
inline const std::string kPaintMtl = "newmtl red\nKd 1 0 0\nnewmtl grey\nKd 0.5 0.5 0.5\n";

inline const std::string kSquarePly = R"(ply
format ascii 1.0
comment one face with four corners
element vertex 4
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
1 1 0
0 1 0
4 0 1 2 3
)";

inline std::string binarySquarePly() {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
      "float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  for (const float c : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) append(bytes, c);
  for (const std::vector<int>& face : {std::vector<int>{0, 1, 2}, {0, 2, 3}}) {
    append(bytes, static_cast<unsigned char>(face.size()));
    for (const int corner : face) append(bytes, corner);
  }
  return bytes;
}

inline std::string binaryStl(unsigned triangles) {
  std::string bytes(80, ' ');
  append(bytes, triangles);
  for (unsigned t = 0; t < triangles; ++t) {
    const auto z = static_cast<float>(t);
    for (const float c : {0.f, 0.f, 1.f, 0.f, 0.f, z, 1.f, 0.f, z, 0.f, 1.f, z}) append(bytes, c);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

/// The corners (0,0,0), (1,0,0), (0,1,0) and the indices of one triangle, as a glTF buffer.
inline std::string gltfBuffer(std::uint16_t last_index = 2) {
  std::string bytes;
  for (const float c : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) append(bytes, c);
  for (const std::uint16_t i : {std::uint16_t{0}, std::uint16_t{1}, last_index}) append(bytes, i);
  bytes.resize(44);  // chunks are padded to four bytes
  return bytes;
}

/// That triangle twice: below a parent moved by (0,10,0), once turned a quarter about z and once scaled by
/// two.
inline nlohmann::json gltfDocument() {
  using nlohmann::json;
  return json{{"asset", {{"version", "2.0"}}},
              {"scene", 0},
              {"scenes", {{{"nodes", {0}}}}},
              {"nodes",
               {{{"children", {1, 2}}, {"translation", {0, 10, 0}}},
                {{"mesh", 0}, {"name", "turned"}, {"rotation", {0, 0, 0.70710678, 0.70710678}}},
                {{"mesh", 0}, {"scale", {2, 2, 2}}}}},
              {"meshes",
               {{{"name", "leaf"},
                 {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}}}}}},
              {"materials",
               {{{"name", "paint"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.25, 0.5, 1.0, 1.0}}}}}}},
              {"accessors",
               {{{"bufferView", 0},
                 {"componentType", 5126},
                 {"count", 3},
                 {"type", "VEC3"},
                 {"min", {0, 0, 0}},
                 {"max", {1, 1, 0}}},
                {{"bufferView", 1}, {"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}}}},
              {"bufferViews",
               {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 36}},
                {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 6}}}},
              {"buffers", {{{"byteLength", 44}}}}};
}

inline std::string glb(const nlohmann::json& document, const std::string& buffer) {
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  append(bytes, std::uint32_t{2});
  append(bytes, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + buffer.size()));
  append(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += "JSON" + text;
  append(bytes, static_cast<std::uint32_t>(buffer.size()));
  bytes += std::string("BIN\0", 4) + buffer;
  return bytes;
}

}  // namespace espalier::tests
