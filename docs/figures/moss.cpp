// The figure of docs/house.md's example: moss on steps, below a bench and on the wall behind them.
#include <algorithm>

#include "docs/examples/moss.h"
#include "docs/figures/figures.h"
#include "render/finish/finished_picture.h"
#include "render/image/tone.h"
#include "render/model/plant_model.h"
#include "sim/grow/grow.h"
#include "sim/light/sky.h"
#include "sim/sweep/sweep.h"
#include "sim/tile/build_world.h"

namespace espalier::figures {
namespace {

using sim::Colour;
using sim::Vec3;

sim::TiledMesh box(Vec3 low_m, Vec3 high_m, Colour colour) {
  sim::Mesh mesh;
  mesh.name = "stones";
  mesh.regions = {"stone"};
  mesh.materials = {{"stone", colour}};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 which(corner & 1, (corner >> 1) & 1, corner >> 2);
    mesh.vertices_m.push_back(glm::mix(low_m, high_m, which));
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  mesh.region.assign(mesh.triangles.size(), 0);
  mesh.material.assign(mesh.triangles.size(), 0);
  return {std::move(mesh), true};
}

}  // namespace

render::Image moss() {
  const Colour stone(0.46f, 0.43f, 0.38f), pale(0.55f, 0.52f, 0.46f), brick(0.30f, 0.17f, 0.12f);
  const std::vector<sim::TiledMesh> meshes = {box({-1.8, -0.1, -0.9}, {2.9, 0.0, 0.9}, stone),       // ground
                                              box({-1.8, 0.0, -0.9}, {2.9, 1.3, -0.72}, brick),      // wall
                                              box({0.55, 0.0, -0.72}, {1.65, 0.2, 0.35}, pale),      // steps
                                              box({0.85, 0.2, -0.72}, {1.65, 0.4, 0.05}, pale),      //
                                              box({1.15, 0.4, -0.72}, {1.65, 0.6, -0.25}, pale),     //
                                              box({-1.15, 0.36, -0.62}, {0.2, 0.44, -0.1}, pale),    // bench
                                              box({-1.0, 0.0, -0.55}, {-0.88, 0.36, -0.17}, stone),  //
                                              box({-0.07, 0.0, -0.55}, {0.05, 0.36, -0.17}, stone)};  //
  sim::World world = sim::buildWorld(sim::frameAround(meshes, 0.02, 0.2), meshes, 2);
  const auto sky = sim::makeSky({.directions = 250}).directions;

  sim::GrowthSettings settings;
  settings.iterations = 110;
  settings.light.sky = sky;
  std::vector<Vec3> seeds;
  for (const Vec3 at_m : {Vec3(-0.5, 0.03, -0.6), {0.3, 0.03, -0.67}, {0.5, 0.05, -0.2}, {1.0, 0.44, -0.67}})
    seeds.push_back(sim::voxelFromWorld(world.frame(), at_m));
  const sim::Growth growth =
      sim::grow(world, {{"moss", examples::makeMoss(0.42), sim::seedsAt(world.frame(), seeds)}}, settings);

  std::vector<render::PlantModel> models;
  for (const sim::Plant& plant : growth.plants) models.push_back(render::modelPlant(plant, world.frame()));
  const sim::ExposureField light = sim::sweepExposure(world.occupied(), sky);
  render::FinishedScene scene;
  for (const auto& tiled : meshes) scene.model.meshes.push_back(&tiled.mesh);
  for (const auto& model : models) scene.model.plants.push_back(&model);
  scene.frame = world.frame();
  scene.occupied = &world.occupied();
  scene.sky = &light;
  scene.to_sun = {0.5, 0.8, 0.75};
  render::Image image = render::finishedPicture(scene, {{-0.75, 0.9, 2.5}, {0.14, 0.33, -0.3}, 28}, 960, 480);
  const render::ToneCurve tone;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    const Colour display = tone(Colour(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]));
    std::copy_n(&display.r, 3, &image.pixels[i]);
  }
  return image;
}

}  // namespace espalier::figures
