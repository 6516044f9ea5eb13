#include "render/files/gltf.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include "sim/base/error.h"
#include "sim/base/whole_file.h"
#include "tests/support/small_vine.h"

namespace espalier {
namespace {

using render::glbBytes;

tinygltf::Model readGlb(const std::string& bytes) {
  tinygltf::Model model;
  tinygltf::TinyGLTF reader;
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

class Glb : public testing::Test {
 protected:
  sim::Mesh wall_ = tests::wallMesh();
  render::PlantModel vine_ = render::modelPlant(tests::smallVine(), tests::kVineFrame);
  std::string bytes_ = glbBytes({{&wall_}, {&vine_}});
};

TEST_F(Glb, HoldsWhatWasModelled) {
  const auto model = readGlb(bytes_);
  EXPECT_EQ(model.asset.generator, "Espalier");
  EXPECT_EQ(at(model.scenes, model.defaultScene).nodes.size(), 2u);
  std::set<std::string> names;
  for (const auto& node : model.nodes) names.insert(node.name);
  EXPECT_EQ(names, (std::set<std::string>{"wall", "vine", "vine stems", "vine leaf"}));
  for (const auto& node : model.nodes) {
    if (node.name != "vine stems" && node.name != "vine leaf") continue;
    const render::ModelMesh& source = node.name == "vine stems" ? vine_.stems : vine_.elements[0];
    const auto& primitive = at(model.meshes, node.mesh).primitives.at(0);
    EXPECT_EQ(at(model.accessors, primitive.indices).count, 3 * source.triangles.size());
    EXPECT_EQ(at(model.materials, primitive.material).doubleSided, node.name == "vine leaf");
    for (const auto& [name, index] : primitive.attributes) {
      EXPECT_EQ(at(model.accessors, index).count, source.positions_m.size()) << name;
    }
    EXPECT_EQ(primitive.attributes.size(), 4u);
    const auto& positions = at(model.accessors, primitive.attributes.at("POSITION"));
    sim::Vec3f low = source.positions_m[0], high = low;
    for (const auto p : source.positions_m) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(static_cast<float>(positions.minValues[k]), (&low.x)[k]);
      EXPECT_EQ(static_cast<float>(positions.maxValues[k]), (&high.x)[k]);
    }
    const auto& colours = at(model.accessors, primitive.attributes.at("COLOR_0"));
    const auto& view = at(model.bufferViews, colours.bufferView);
    for (std::size_t i = 0; i < source.exposures.size(); ++i) {
      EXPECT_NEAR(model.buffers[0].data[view.byteOffset + 4 * i] / 255.0f, source.exposures[i],
                  0.5f / 255 + 1e-6f);
    }
  }
}

TEST_F(Glb, TheSceneKeepsItsMaterials) {
  const auto model = readGlb(bytes_);
  const auto& primitives = at(model.meshes, model.nodes[0].mesh).primitives;
  ASSERT_EQ(primitives.size(), 2u);
  for (std::size_t m = 0; m < 2; ++m) {
    const auto& material = at(model.materials, primitives[m].material);
    EXPECT_EQ(material.name, wall_.materials[m].name);
    EXPECT_FLOAT_EQ(static_cast<float>(material.pbrMetallicRoughness.baseColorFactor[0]),
                    wall_.materials[m].colour.r);
    EXPECT_EQ(at(model.accessors, primitives[m].indices).count, 36u);
    EXPECT_EQ(at(model.accessors, primitives[m].attributes.at("POSITION")).count, 8u);
  }
}

TEST_F(Glb, PlantsOfOneKindShareTheirMaterials) {
  render::PlantModel other = vine_;
  other.name = "another";
  other.stems.name = "another stems";
  for (auto& element : other.elements) element.name = "another" + element.name.substr(vine_.name.size());
  const auto model = readGlb(glbBytes({{}, {&vine_, &other}}));
  EXPECT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.meshes.size(), 4u);
}

TEST_F(Glb, TheSameBytesAgain) {
  EXPECT_EQ(bytes_, glbBytes({{&wall_}, {&vine_}}));
}

TEST_F(Glb, EmptyAndStrangeThings) {
  const render::PlantModel nothing;
  EXPECT_TRUE(readGlb(glbBytes({{}, {&nothing}})).nodes.empty());
  sim::Mesh latin = wall_;
  latin.name = "caf\xe9";  // not UTF-8
  EXPECT_EQ(readGlb(glbBytes({{&latin}, {}})).nodes[0].name, "caf\xef\xbf\xbd");
  sim::Mesh broken = wall_;
  broken.triangles[3][1] = 999;
  EXPECT_THROW(glbBytes({{&broken}, {}}), sim::InputError);
}

TEST_F(Glb, SaysByWhatAndFromWhatItWasMade) {
  const sim::Provenance made_by{
      "Espalier 9.8.7", 9007199254740991u, {{"s.yaml", "scene", 0xabcu}, {"caf\xe9", "mesh", 1}}};
  const auto asset = readGlb(glbBytes({{&wall_}, {}}, made_by)).asset;
  EXPECT_EQ(asset.generator, "Espalier 9.8.7");
  EXPECT_EQ(asset.extras.Get("seed").Get<std::string>(), "9007199254740991");
  const auto& inputs = asset.extras.Get("inputs");
  ASSERT_EQ(inputs.ArrayLen(), 2u);
  EXPECT_EQ(inputs.Get(0).Get("file").Get<std::string>(), "s.yaml");
  EXPECT_EQ(inputs.Get(0).Get("kind").Get<std::string>(), "scene");
  EXPECT_EQ(inputs.Get(0).Get("xxh3").Get<std::string>(), "0000000000000abc");
  EXPECT_EQ(inputs.Get(1).Get("file").Get<std::string>(), "caf\xef\xbf\xbd");
}

TEST_F(Glb, TheKhronosValidatorIsContent) {
  const char* modules = std::getenv("ESPALIER_NODE_MODULES");
  const std::string node_path =
      modules ? modules : std::string(ESPALIER_SOURCE_DIR) + "/build/node/node_modules";
  if (std::system("node --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "node is not installed";
  for (const auto& [name, bytes] : {std::pair{"full", bytes_}, std::pair{"empty", glbBytes({})}}) {
    const auto file = std::filesystem::path(testing::TempDir()) / (std::string("espalier_") + name + ".glb");
    sim::writeWhole(file, bytes);
    const std::string command = "NODE_PATH='" + node_path +
                                "' node '" ESPALIER_SOURCE_DIR "/tests/render/files/validate_glb.cjs' '" +
                                file.string() + "'";
    const int status = WEXITSTATUS(std::system(command.c_str()));
    std::filesystem::remove(file);
    if (status == 77)
      GTEST_SKIP() << "gltf-validator is not installed: tests/support/install_gltf_validator.sh";
    EXPECT_EQ(status, 0) << name;
  }
}

}  // namespace
}  // namespace espalier
