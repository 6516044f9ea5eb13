#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "rules/front/colonize.h"
#include "rules/front/lengths.h"
#include "rules/growth/voxel_widths.h"
#include "scenes/job/run.h"
#include "scenes/prepare/attractors.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "tests/bench/rows.h"

namespace espalier::bench {
namespace {

constexpr const char* kBranchingRow = "12 what branches";

/// What the front of a scene's first plant is alone; lengths that its rules leave out as the process takes
/// them.
struct BareFront {
  std::vector<sim::Vec3> attractors;
  sim::Vec3 start{0.0};
  rules::FrontRules rules;
};

BareFront bareFront(const scenes::Scene& scene, const scenes::Site& site) {
  const double voxel_m = site.world.frame().voxel_m;
  const scenes::PlantSpec& plant = scene.plants[0];
  const rules::Colonization& rules = plant.rules->colonization;
  const auto all = scenes::attractorsOf(scene, site);
  const auto attractors = std::find_if(all.begin(), all.end(), [&](const scenes::NamedPoints& points) {
    return points.name == scenes::attractorsFor(plant);
  });
  const rules::FrontLengths suitable =
      rules::suitableLengths(rules::spacingOf(rules::sortedAttractors(attractors->at_vx)));
  const auto widths = [&](const std::optional<rules::Distance>& length, double otherwise) {
    return length ? rules::widths(*length, voxel_m) : otherwise;
  };
  return {attractors->at_vx,
          sim::voxelFromWorld(site.world.frame(), plant.seeds[0].at_m),
          {widths(rules.step, suitable.step), widths(rules.influence, suitable.influence),
           widths(rules.kill, suitable.kill)}};
}

/// A scene of the library, all of its attractors so many.
void benchOne(const char* name, int count, Report& report) {
  namespace fs = std::filesystem;
  auto scene = scenes::readScene(fmt::format("{}/scenes/library/{}.yaml", ESPALIER_SOURCE_DIR, name));
  if (!scene) throw sim::InputError(scenes::format(scene.problems()));
  for (scenes::AttractorsSpec& attractors : scene->attractors) attractors.strewing.count = count;
  scene->film.reset();
  const scenes::Site site = scenes::makeSite(*scene);
  const BareFront front = bareFront(*scene, site);
  rules::Colony colony;
  const double front_s = medianSeconds([&] {
    colony = rules::colonize(front.attractors, {&front.start, 1}, front.rules, scene->iterations);
  });
  scenes::RunOptions options;
  options.folder = fs::temp_directory_path() / fmt::format("espalier.bench.{}", ::getpid());
  const scenes::Report run = scenes::runScene(*scene, options, {.keep = false});
  fs::remove_all(options.folder);
  std::map<std::string, double> stages_s(run.run.stages_s.begin(), run.run.stages_s.end());
  std::size_t triangles = 0;
  for (const auto& plant : run.growth->plants) triangles += plant.triangles.value_or(0);
  report.note(fmt::format("  {}, {} attractors: {} nodes of the first plant, {} triangles of all", name,
                          count, colony.position.size(), triangles));
  const auto add = [&](const char* what, double seconds) { report.add({kBranchingRow, what, seconds, "s"}); };
  add("    the world", stages_s["tiling"]);
  add("    the first plant's front, bare", front_s);
  add("    growth in the world, fronts included", stages_s["growing"]);
  add("    forms, and light with what bounces",
      stages_s["forming"] + stages_s["lighting"] + stages_s["bouncing light"]);
  add("    the model", stages_s["modelling"]);
  add("    the pictures", stages_s["drawing"]);
  add("    all of it", run.run.total_s);
}

}  // namespace

void benchBranching(Report& report) {
  report.title("12. Bolts and vessels by their attractors: scenes of the library, one run each");
  for (const int count : {250, 1000, 4000, 16'000}) benchOne("lightning", count, report);
  for (const int count : {1000, 4000, 16'000}) benchOne("vessels", count, report);
}

}  // namespace espalier::bench
