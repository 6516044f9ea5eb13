#include <gtest/gtest.h>

#include "render/files/gltf.h"
#include "render/files/obj.h"
#include "tests/support/glb.h"
#include "tests/support/meshes.h"
#include "tests/support/small_vine.h"

/// What is seen through says so in the files.
namespace espalier {
namespace {

class TranslucentFiles : public testing::Test {
 protected:
  static render::PlantModel vine(float stems, float leaves) {
    sim::Plant plant = tests::smallVine();
    plant.stem_alpha = stems;
    for (sim::ElementShape& shape : plant.shapes) shape.alpha = leaves;
    return render::modelPlant(plant, tests::kVineFrame);
  }
};

TEST_F(TranslucentFiles, GlbBlendsAndHasItInTheColour) {
  sim::Mesh pane = tests::boxMesh({0, 0, 0}, {1, 1, 1}, "pane");
  sim::setOpacity(pane.materials[0], 0.25);
  const render::PlantModel clear = vine(0.5f, 0.75f), plain = vine(1.0f, 1.0f);
  const auto model = tests::readGlb(render::glbBytes({{&pane}, {&clear}}));
  std::map<std::string, double> alpha;
  for (const tinygltf::Material& material : model.materials) {
    EXPECT_EQ(material.alphaMode, "BLEND") << material.name;
    alpha[material.name] = material.pbrMetallicRoughness.baseColorFactor.at(3);
  }
  EXPECT_EQ(alpha.at(pane.materials[0].name), 0.25);
  EXPECT_EQ(alpha.at("stems"), 0.5);
  EXPECT_EQ(alpha.at("leaf"), 0.75);
  for (const tinygltf::Material& material : tests::readGlb(render::glbBytes({{}, {&plain}})).materials)
    EXPECT_NE(material.alphaMode, "BLEND") << material.name;
}

TEST_F(TranslucentFiles, MtlHasItAsItsDissolve) {
  const render::PlantModel clear = vine(0.5f, 0.75f);
  const std::string mtl = render::objLibrary(
                              {}, [&](const auto& take) { take(clear); }, "plant")
                              .mtl;
  EXPECT_NE(mtl.find("newmtl stems"), mtl.npos);
  EXPECT_NE(mtl.find("d 0.5\n"), mtl.npos) << mtl;
  EXPECT_NE(mtl.find("d 0.75\n"), mtl.npos) << mtl;
}

}  // namespace
}  // namespace espalier
