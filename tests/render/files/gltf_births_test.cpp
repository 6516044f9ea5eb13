#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "render/files/gltf.h"
#include "render/model/plant_model.h"
#include "tests/support/glb.h"
#include "tests/support/small_vine.h"

/// _BIRTH: the iteration in which a part of a plant was placed.
namespace espalier::render {
namespace {

constexpr std::int32_t kLast = 90;

/// A vine that took longer to grow.
sim::Plant slowVine(std::int32_t last = kLast) {
  sim::Plant vine = tests::smallVine();
  const auto nodes = static_cast<std::int32_t>(vine.skeleton.born.size());
  for (std::int32_t n = 0; n < nodes; ++n)
    vine.skeleton.born[static_cast<std::size_t>(n)] = n * last / (nodes - 1);
  for (sim::PlacedElement& element : vine.elements)
    element.born = vine.skeleton.born[static_cast<std::size_t>(element.node)];
  return vine;
}

std::set<float> distinct(const std::vector<float>& values) {
  return {values.begin(), values.end()};
}

TEST(GltfBirths, AreThoseOfElementsAndLieBetweenThoseOfNodes) {
  const sim::Plant vine = slowVine();
  const PlantModel model = modelPlant(vine, tests::kVineFrame);
  EXPECT_EQ(model.last_birth, kLast);
  const auto file = tests::readGlb(glbBytes({{}, {&model}}));
  const auto births = [&](const char* mesh) {
    return tests::valuesOf<float>(file, tests::primitiveOf(file, mesh).attributes.at("_BIRTH"));
  };
  std::set<float> of_elements;
  for (const sim::PlacedElement& element : vine.elements)
    of_elements.insert(static_cast<float>(element.born));
  EXPECT_EQ(distinct(births("vine leaf")), of_elements);
  EXPECT_GT(of_elements.size(), 1u);
  const auto stems = births("vine stems");
  const auto ages =
      tests::valuesOf<float>(file, tests::primitiveOf(file, "vine stems").attributes.at("_AGE"));
  ASSERT_EQ(stems.size(), ages.size());
  for (std::size_t v = 0; v < stems.size(); ++v) EXPECT_NEAR(stems[v], kLast * ages[v], 0.04);
  EXPECT_EQ(*std::max_element(stems.begin(), stems.end()), kLast);
}

TEST(GltfBirths, OfInstancesAreWholeNumbersAsSmallAsTheyCanBe) {
  for (const std::int32_t last : {kLast, 100'000}) {
    const sim::Plant vine = slowVine(last);
    const PlantModel model = modelPlant(vine, tests::kVineFrame, {.instances = true});
    const auto file = tests::readGlb(glbBytes({{}, {&model}}));
    const auto node = std::find_if(file.nodes.begin(), file.nodes.end(),
                                   [](const auto& one) { return one.name == "vine leaf"; });
    ASSERT_NE(node, file.nodes.end());
    const int number =
        node->extensions.at("EXT_mesh_gpu_instancing").Get("attributes").Get("_BIRTH").GetNumberAsInt();
    const bool short_enough = last < 65'536;
    EXPECT_EQ(file.accessors[static_cast<std::size_t>(number)].componentType,
              short_enough ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT : TINYGLTF_COMPONENT_TYPE_FLOAT);
    std::vector<float> births;
    if (short_enough) {
      for (const std::uint16_t birth : tests::valuesOf<std::uint16_t>(file, number)) births.push_back(birth);
    } else {
      births = tests::valuesOf<float>(file, number);
    }
    std::vector<float> expected;
    for (const sim::PlacedElement& element : vine.elements)
      expected.push_back(static_cast<float>(element.born));
    EXPECT_EQ(births, expected);
  }
}

}  // namespace
}  // namespace espalier::render
