#include <fmt/format.h>

#include "render/model/plant_model.h"
#include "rules/front/colonize.h"
#include "rules/growth/make_process.h"
#include "sim/base/hasher.h"
#include "sim/base/parallel.h"
#include "tests/bench/dome.h"
#include "tests/bench/rows.h"
#include "tests/bench/vine_wall.h"

namespace espalier::bench {
namespace {

constexpr double kDrawnVoxel_m = 0.02;

/// A tree in the dome, with twigs of 3 mm and a trunk of a third of a metre.
sim::Plant grownTree() {
  const std::vector<sim::Vec3> attractors = dome(200'000);
  const sim::Vec3 start(0.0);
  const rules::Colony colony = rules::colonize(attractors, {&start, 1}, {0.08, 2.5, 0.12}, 100'000);
  sim::Plant plant;
  plant.name = "tree";
  plant.girth.twig_vx = 0.003 / kDrawnVoxel_m;
  plant.girth.most_vx = 0.3 / kDrawnVoxel_m;
  plant.skeleton.parent = colony.parent;
  plant.skeleton.born = colony.born;
  for (const sim::Vec3& place : colony.position) plant.skeleton.position_vx.push_back(place / kDrawnVoxel_m);
  return plant;
}

std::uint64_t stateOf(const render::ModelMesh& mesh) {
  sim::Hasher hasher;
  hasher.add(mesh.positions_m);
  hasher.add(mesh.normals);
  return hasher.digest();
}

/// One vine of figure 4's on a wall, without its leaves.
sim::Plant grownVine() {
  constexpr double kSegments = 1e5;
  sim::World world = wallFor(kSegments);
  auto rules = std::make_shared<rules::RuleSet>(figureFour());
  const std::vector<sim::Planting> plantings = {
      {"vine", rules::makeProcess(rules, world.frame().voxel_m), {seedsOn(world).front()}}};
  sim::GrowthSettings settings = settingsFor();
  std::size_t segments = 0;
  settings.progress = [&](const sim::GrowthProgress& progress) { segments = progress.segments; };
  sim::Growing growing(world, plantings, settings);
  while (static_cast<double>(segments) < kSegments && growing.step()) {
  }
  sim::Plant plant = growing.take().plants.front();
  plant.elements.clear();
  return plant;
}

void benchStemsOf(const std::string& name, const sim::Plant& plant, Report& report) {
  constexpr const char* kRow = "9 stems";
  const sim::Frame frame{sim::Vec3(0.0), kDrawnVoxel_m, sim::Voxel(1)};
  render::PlantModel model;
  const auto draw = [&] { model = render::modelPlant(plant, frame); };
  const double seconds = medianSeconds(draw);
  double one_thread_s = 0.0;
  sim::onThreads(1, [&] { one_thread_s = medianSeconds(draw); });
  const double cpu_s = cpuSeconds();
  draw();
  const double cpu_used_s = cpuSeconds() - cpu_s;
  const std::uint64_t state = stateOf(model.stems);
  const auto scaled = [&](double s) { return 1e8 * s / static_cast<double>(plant.skeleton.size()); };
  report.note(fmt::format("  {}: {} nodes, {} vertices, {} triangles, {} pairs of limbs that meet", name,
                          plant.skeleton.size(), model.stems.positions_m.size(), model.stems.triangles.size(),
                          model.meeting_limbs));
  report.add({kRow, fmt::format("    100,000 nodes, {} threads", sim::threadCount()), scaled(seconds), "ms",
              state, Target{500.0, false}});
  report.add({kRow, "      of CPU", scaled(cpu_used_s), "ms", state});
  report.add({kRow, "    one thread", scaled(one_thread_s), "ms", state});
}

}  // namespace

void benchStems(Report& report) {
  report.title("9. The surface of a plant's stems, from its skeleton on");
  benchStemsOf("a tree of the dome", grownTree(), report);
  benchStemsOf("a vine of figure 4's on a wall", grownVine(), report);
}

}  // namespace espalier::bench
