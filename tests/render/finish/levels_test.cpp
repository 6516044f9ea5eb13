#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/finish/ray_scene.h"
#include "render/image/camera.h"
#include "render/model/plant_model.h"
#include "sim/base/random.h"
#include "tests/support/random_trees.h"

namespace espalier {
namespace {

using sim::Vec3;

const sim::Frame kUnit{Vec3(0.0), 1.0, sim::Voxel(1)};

render::PlantModel levelOf(const sim::Plant& plant, int level) {
  return render::modelPlant(plant, kUnit, {.error = render::errorOfLevel(level)});
}

/// How much of a picture a model covers, in pixels, by 16 rays in each at least.
double coverage(const render::PlantModel& model, const render::Camera& camera, int pixels) {
  render::ModelScene scene;
  scene.plants = {&model};
  const render::RayScene rays(scene);
  const render::CameraRays view(camera, 1.0);
  std::size_t hits = 0;
  const int fine = std::max(1, 200 / pixels), across = 4 * fine * pixels;
  for (int y = 0; y < across; ++y) {
    for (int x = 0; x < across; x += 4) {
      std::array<sim::Vec3f, 4> ways;
      for (int i = 0; i < 4; ++i)
        ways[static_cast<std::size_t>(i)] =
            sim::Vec3f(view.direction((x + i + 0.5) / across, (y + 0.5) / across));
      for (const auto& hit : rays.firstHits(sim::Vec3f(camera.eye_m), ways)) hits += hit.any();
    }
  }
  return static_cast<double>(hits) / (16.0 * fine * fine);
}

TEST(Levels, CoverAsManyPixelsWhereTheirErrorIsAPixel) {
  sim::Plant plant;
  plant.skeleton = tests::randomTree(4);
  Vec3 low(1e9), high(-1e9);
  for (const Vec3 p : plant.skeleton.position_vx) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const render::PlantModel finest = levelOf(plant, 0);
  std::size_t triangles = finest.stems.triangles.size();
  for (int level = 1; level < render::kLevels; ++level) {
    const render::PlantModel model = levelOf(plant, level);
    EXPECT_LT(model.stems.triangles.size(), triangles);
    triangles = model.stems.triangles.size();
    const double wide = 1.1 * glm::length(high - low), far = 20.0 * wide;
    const auto pixels = static_cast<int>(wide / (render::errorOfLevel(level) * plant.girth.twig_vx));
    for (int view = 0; view < 8; ++view) {
      const glm::dvec2 circle = sim::unitCircle(view / 8.0);
      render::Camera camera;
      camera.target_m = 0.5 * (low + high);
      camera.eye_m = camera.target_m + far * glm::normalize(Vec3(circle.x, 0.3 * (view % 3 - 1), circle.y));
      camera.fov_deg = 2.0 * std::atan(0.5 * wide / far) * 180.0 / M_PI;
      const double wanted = coverage(finest, camera, pixels);
      EXPECT_NEAR(coverage(model, camera, pixels) / wanted, 1.0, 0.03)
          << "level " << level << ", view " << view;
    }
  }
}

}  // namespace
}  // namespace espalier
