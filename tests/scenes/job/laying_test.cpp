#include <gtest/gtest.h>

#include <stdexcept>

#include "rules/growth/laid_measure.h"
#include "scenes/prepare/plantings.h"
#include "scenes/read/read_scene.h"
#include "sim/grow/grow.h"
#include "sim/grow/pieces.h"
#include "sim/sense/scene_surface.h"
#include "tests/support/scratch.h"

/// Scenes whose plants lay elements on surfaces: the library's, and meshes of strangers.
namespace espalier::scenes {
namespace {

struct Laid {
  Scene scene;
  Site site;
  sim::Growth growth;
};

Laid laidIn(const std::filesystem::path& file) {
  auto read = readScene(file);
  if (!read) throw std::runtime_error(format(read.problems()));
  Scene scene = *read;
  std::erase_if(scene.plants, [](const PlantSpec& plant) { return !lays(plant); });
  Site site = makeSite(scene);
  const auto plantings = makePlantings(scene, site);
  sim::Growth growth = sim::grow(site.world, plantings, growthSettings(scene, site, {}));
  return {std::move(scene), std::move(site), std::move(growth)};
}

rules::LaidMeasure measured(const Laid& laid, std::size_t planting) {
  const sim::Stand& stand = laid.growth.stands.at(planting);
  return rules::measureLaid(laid.scene.plants.at(planting).rules,
                            std::span(laid.growth.plants).subspan(stand.first, stand.count),
                            sim::surfaceOf(laid.site.world.frame(), laid.site.meshes), laid.site.world);
}

/// Of all that does not cross by its rules: by boxes first, then exactly.
void expectNoCrossing(const Laid& laid) {
  struct Piece {
    sim::LatticeBox box;
    std::vector<sim::LatticeTriangle> triangles;
  };
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < laid.growth.stands.size(); ++i) {
    // Sets of regions have shapes of their own, in the same order.
    const auto& elements = laid.scene.plants[i].rules->elements;
    for (std::size_t k = 0; k < laid.growth.stands[i].count; ++k) {
      const sim::Plant& plant = laid.growth.plants[laid.growth.stands[i].first + k];
      std::vector<sim::FacetShape> shapes;
      for (const sim::ElementShape& shape : plant.shapes) shapes.push_back(sim::facetShape(shape.polygons));
      for (const sim::PlacedElement& element : plant.elements) {
        if (elements.at(static_cast<std::size_t>(element.shape) % elements.size()).crosses) continue;
        sim::Facets facets;
        ASSERT_TRUE(sim::place(element, shapes[static_cast<std::size_t>(element.shape)], facets));
        Piece piece{facets.box, {}};
        for (const auto& t : facets.shape->triangles)
          piece.triangles.push_back({facets.corners[t[0]], facets.corners[t[1]], facets.corners[t[2]]});
        pieces.push_back(std::move(piece));
      }
    }
  }
  ASSERT_GT(pieces.size(), 20u);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!sim::meet(pieces[i].box, pieces[k].box)) continue;
      for (const auto& a : pieces[i].triangles) {
        for (const auto& b : pieces[k].triangles) ASSERT_FALSE(sim::cross(a, b)) << i << " crosses " << k;
      }
    }
  }
}

TEST(Laying, PavesThePatio) {
  const Laid laid = laidIn(tests::sourceFolder() / "scenes/library/paving.yaml");
  expectNoCrossing(laid);
  const rules::LaidMeasure measure = measured(laid, 0);
  EXPECT_GT(measure.covered_vx2, 0.8 * measure.surface_vx2);
  EXPECT_NEAR(measure.joints.mean_vx, measure.joints.asked_vx, 0.05 * measure.joints.asked_vx);
}

TEST(Laying, PavesTheCourtAroundItsBeds) {
  const Laid laid = laidIn(tests::sourceFolder() / "scenes/library/courtyard.yaml");
  expectNoCrossing(laid);
  const rules::LaidMeasure measure = measured(laid, 0);
  EXPECT_GT(measure.covered_vx2, 0.8 * measure.surface_vx2);
  const sim::Frame& frame = laid.site.world.frame();
  for (const sim::PlacedElement& element : laid.growth.plants.front().elements)
    EXPECT_NEAR(sim::worldFromVoxel(frame, element.position_vx).y, -0.001, 1e-5) << "it lies on the sand";
}

TEST(Laying, CoversTheCottagesGrounds) {
  const Laid laid = laidIn(tests::sourceFolder() / "scenes/library/cottage.yaml");
  expectNoCrossing(laid);
  const auto share = [&](std::size_t planting) {
    const rules::LaidMeasure measure = measured(laid, planting);
    return measure.covered_vx2 / measure.surface_vx2;
  };
  EXPECT_GT(share(0), 0.85) << "shingles";
  EXPECT_GT(share(1), 0.6) << "cobbles";
  EXPECT_NEAR(share(2), 0.5, 0.02) << "moss";
  EXPECT_NEAR(share(3), 0.35, 0.02) << "the meadow";
}

/// On meshes that nobody made for it.
TEST(Laying, LiesOnStrangersMeshes) {
  const std::filesystem::path meshes = ESPALIER_SHARED_MESHES;
  if (!std::filesystem::exists(meshes / "bunny.obj") || !std::filesystem::exists(meshes / "house_3.obj"))
    GTEST_SKIP() << "no meshes in " << meshes;
  const tests::Scratch scratch;
  const Laid house = laidIn(scratch.write(
      "house.yaml", "espalier: scene\nname: house\nmeshes: [{file: " + (meshes / "house_3.obj").string() +
                        "}]\nworld: {voxel: 5 cm, margin: 30 cm}\nplants: [{name: shingles, rules: shingles, "
                        "scatter: {region: house_3, count: 12}}]\niterations: 1\n"));
  expectNoCrossing(house);
  const rules::LaidMeasure roofs = measured(house, 0);
  EXPECT_GT(roofs.covered_vx2, 0.7 * roofs.surface_vx2);
  const Laid bunny = laidIn(scratch.write(
      "bunny.yaml",
      "espalier: scene\nname: bunny\nmeshes: [{file: " + (meshes / "bunny.obj").string() +
          ", unit: m, scale: 10}]\nworld: {voxel: 2 cm, margin: 20 cm}\nplants:\n- name: stones\n"
          "  rules: {base: cobbles, diffusion: {off: 1.5 cm, gap: {min: 4 mm, max: 4 cm}}}\n"
          "  scatter: {region: bunny, count: 4}\niterations: 1\n"));
  expectNoCrossing(bunny);
  EXPECT_GT(bunny.growth.plants[0].elements.size() + bunny.growth.plants[1].elements.size() +
                bunny.growth.plants[2].elements.size() + bunny.growth.plants[3].elements.size(),
            200u);
}

}  // namespace
}  // namespace espalier::scenes
