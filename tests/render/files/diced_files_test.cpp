#include "render/files/diced_files.h"

#include <gtest/gtest.h>

#include <sstream>

#include "render/image/tone.h"
#include "tests/support/glb.h"
#include "tests/support/small_vine.h"

namespace espalier::render {
namespace {

class DicedFiles : public testing::Test {
 protected:
  DicedMeshes meshes() const {
    return [this](const std::function<void(const DicedMesh&)>& take) {
      take(DicedMesh());
      take(wall_);
    };
  }
  std::string glb(DicedLight light) const {
    std::stringstream out;
    writeDicedGlb(out, meshes(), light, {"Espalier 9", 7, {}});
    return std::move(out).str();
  }

  DicedMesh wall_ = diced(uncut(tests::wallMesh(), tests::kVineFrame), tests::kVineFrame,
                          [](sim::Voxel v) { return sim::Colour(v) / 32.0f; });
};

TEST_F(DicedFiles, GlbHasLinearColoursAndSaysWhetherTheyAreLit) {
  const tinygltf::Model model = tests::readGlb(glb(DicedLight::given));
  ASSERT_EQ(model.nodes.size(), 1u) << "nothing of the empty one";
  EXPECT_EQ(model.asset.generator, "Espalier 9");
  const auto& primitive = tests::primitiveOf(model, "wall");
  const auto places = tests::valuesOf<sim::Vec3f>(model, primitive.attributes.at("POSITION"));
  EXPECT_EQ(places, wall_.positions_m);
  const auto& about = tests::at(model.accessors, primitive.attributes.at("COLOR_0"));
  EXPECT_TRUE(about.normalized);
  EXPECT_EQ(about.type, TINYGLTF_TYPE_VEC4);
  const auto colours =
      tests::valuesOf<std::array<std::uint16_t, 4>>(model, primitive.attributes.at("COLOR_0"));
  ASSERT_EQ(colours.size(), wall_.colours.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    EXPECT_NEAR(colours[i][1] / 65535.0, wall_.colours[i].g, 1e-5);
    EXPECT_EQ(colours[i][3], 65535);
  }
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_TRUE(model.materials[0].doubleSided);
  EXPECT_EQ(model.materials[0].extensions.count("KHR_materials_unlit"), 1u);
  EXPECT_EQ(model.extensionsUsed, std::vector<std::string>{"KHR_materials_unlit"});
  EXPECT_TRUE(model.extensionsRequired.empty()) << "readers may do without";
  const tinygltf::Model to_light = tests::readGlb(glb(DicedLight::wanted));
  EXPECT_TRUE(to_light.materials[0].extensions.empty());
  EXPECT_TRUE(to_light.extensionsUsed.empty());
}

TEST_F(DicedFiles, ObjHasDisplayColoursBehindThePlaces) {
  std::ostringstream out;
  writeDicedObj(out, meshes(), {"Espalier 9", 7, {}});
  std::istringstream lines(std::move(out).str());
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "# Espalier 9, seed 7");
  std::getline(lines, line);
  EXPECT_EQ(line, "o wall");
  std::size_t vertices = 0, faces = 0;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "v") {
      sim::Vec3f p;
      sim::Colour c;
      words >> p.x >> p.y >> p.z >> c.r >> c.g >> c.b;
      ASSERT_FALSE(words.fail()) << line;
      EXPECT_EQ(p, wall_.positions_m[vertices]);
      EXPECT_NEAR(c.r, srgbFromLinear(wall_.colours[vertices].r), 1e-4);
      ++vertices;
    } else {
      ASSERT_EQ(keyword, "f") << line;
      std::array<std::uint32_t, 3> t{};
      words >> t[0] >> t[1] >> t[2];
      for (std::uint32_t& corner : t) --corner;
      EXPECT_EQ(t, wall_.triangles[faces]);
      ++faces;
    }
  }
  EXPECT_EQ(vertices, wall_.positions_m.size());
  EXPECT_EQ(faces, wall_.triangles.size());
}

TEST_F(DicedFiles, TheKhronosValidatorFindsNoFault) {
  for (const DicedLight light : {DicedLight::given, DicedLight::wanted}) {
    const int status = tests::khronosStatus(glb(light));
    if (status == 77)
      GTEST_SKIP() << "gltf-validator is not installed: tests/support/install_gltf_validator.sh";
    EXPECT_EQ(status, 0);
  }
  std::stringstream empty;
  writeDicedGlb(
      empty, [](const auto&) {}, DicedLight::given);
  EXPECT_EQ(tests::khronosStatus(std::move(empty).str()), 0);
}

}  // namespace
}  // namespace espalier::render
