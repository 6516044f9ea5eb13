#include <gtest/gtest.h>

#include "render/files/gltf.h"
#include "tests/support/glb.h"
#include "tests/support/meshes.h"

namespace espalier {
namespace {

tinygltf::Material materialOf(const sim::Colour& emits, std::vector<std::string>* extensions = nullptr) {
  sim::Mesh lamp = tests::boxMesh({0, 0, 0}, {1, 1, 1}, "lamp");
  lamp.materials[0].emissive = emits;
  const auto model = tests::readGlb(render::glbBytes({{&lamp}, {}}));
  if (extensions) *extensions = model.extensionsUsed;
  return model.materials.at(0);
}

TEST(GltfEmission, LightAboveOneHasItsStrength) {
  std::vector<std::string> used;
  const tinygltf::Material dim = materialOf({0.25f, 0.5f, 1.0f}, &used);
  EXPECT_EQ(dim.emissiveFactor, (std::vector<double>{0.25, 0.5, 1.0}));
  EXPECT_TRUE(dim.extensions.empty());
  EXPECT_TRUE(used.empty());
  const tinygltf::Material bright = materialOf({1.0f, 2.0f, 4.0f}, &used);
  EXPECT_EQ(bright.emissiveFactor, (std::vector<double>{0.25, 0.5, 1.0}));
  constexpr const char* kStrength = "KHR_materials_emissive_strength";
  ASSERT_TRUE(bright.extensions.contains(kStrength));
  EXPECT_EQ(bright.extensions.at(kStrength).Get("emissiveStrength").GetNumberAsDouble(), 4.0);
  EXPECT_EQ(used, std::vector<std::string>{kStrength});
}

}  // namespace
}  // namespace espalier
