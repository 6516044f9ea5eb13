#include <gtest/gtest.h>

#include "render/files/gltf.h"
#include "tests/support/glb.h"
#include "tests/support/small_vine.h"

/// What grew last has a colour of its own, in models and files.
namespace espalier {
namespace {

const sim::Colour kPale(0.9f, 0.8f, 0.6f);

render::PlantModel shooting(bool pale) {
  sim::Plant plant = tests::smallVine();
  plant.stem_colour = {0.5f, 0.2f, 0.1f};
  if (pale) plant.shoot_colour = kPale;
  return render::modelPlant(plant, tests::kVineFrame);
}

TEST(Shoots, TintWhatGrewLast) {
  EXPECT_TRUE(shooting(false).stems.tints.empty());
  const render::ModelMesh stems = shooting(true).stems;
  ASSERT_EQ(stems.tints.size(), stems.positions_m.size());
  float oldest = 1.0f, youngest = 0.0f;
  for (std::size_t v = 0; v < stems.tints.size(); ++v) {
    const sim::Colour colour = stems.base_colour * stems.tints[v];
    const float youth = stems.youths[v];
    EXPECT_LT(glm::distance(colour, glm::mix(stems.base_colour, kPale, youth * youth)), 1e-5f);
    oldest = std::min(oldest, youth);
    youngest = std::max(youngest, youth);
  }
  EXPECT_LT(oldest, 0.5f);
  EXPECT_EQ(youngest, 1.0f);
}

TEST(Shoots, AreInGlbAsColoursOfVertices) {
  const auto stemsOf = [](const render::PlantModel& plant, std::size_t& coloured) {
    const auto model = tests::readGlb(render::glbBytes({{}, {&plant}}));
    coloured = 0;
    for (const tinygltf::Mesh& mesh : model.meshes) {
      for (const tinygltf::Primitive& part : mesh.primitives)
        coloured += mesh.name.ends_with("stems") && part.attributes.contains("COLOR_0");
    }
  };
  std::size_t pale = 0, plain = 0;
  stemsOf(shooting(true), pale);
  stemsOf(shooting(false), plain);
  EXPECT_GT(pale, 0u);
  EXPECT_EQ(plain, 0u);
}

}  // namespace
}  // namespace espalier
