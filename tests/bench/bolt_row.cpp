#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "rules/front/colonize.h"
#include "scenes/job/run.h"
#include "scenes/prepare/attractors.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "tests/bench/rows.h"

namespace espalier::bench {
namespace {

constexpr const char* kBoltRow = "12 lightning";

/// The front alone, to the scene's attractors from its seed.
rules::Colony colonized(const scenes::Scene& scene, const scenes::Site& site) {
  const double voxel_m = site.world.frame().voxel_m;
  const rules::Colonization& rules = scene.plants[0].rules->colonization;
  const auto widths = [&](const std::optional<rules::Distance>& length) {
    return length->metres ? length->number / voxel_m : length->number;
  };
  const sim::Vec3 start = sim::voxelFromWorld(site.world.frame(), scene.plants[0].seeds[0].at_m);
  return rules::colonize(scenes::attractorsOf(scene, site)[0].at_vx, {&start, 1},
                         {widths(rules.step), widths(rules.influence), widths(rules.kill)}, scene.iterations);
}

void benchBoltOf(int count, Report& report) {
  namespace fs = std::filesystem;
  auto scene = scenes::readScene(ESPALIER_SOURCE_DIR "/scenes/library/lightning.yaml");
  if (!scene) throw sim::InputError(scenes::format(scene.problems()));
  scene->attractors[0].strewing.count = count;
  scene->film.reset();
  const scenes::Site site = scenes::makeSite(*scene);
  rules::Colony colony;
  const double front_s = medianSeconds([&] { colony = colonized(*scene, site); });
  scenes::RunOptions options;
  options.folder = fs::temp_directory_path() / fmt::format("espalier.bench.{}", ::getpid());
  const scenes::Report run = scenes::runScene(*scene, options, {.keep = false});
  fs::remove_all(options.folder);
  std::map<std::string, double> stages_s(run.run.stages_s.begin(), run.run.stages_s.end());
  report.note(fmt::format("  {} attractors: {} nodes, {} triangles", count, colony.position.size(),
                          run.growth->plants[0].triangles.value_or(0)));
  const auto add = [&](const char* what, double seconds) { report.add({kBoltRow, what, seconds, "s"}); };
  add("    the front, bare", front_s);
  add("    growth in its world, the front included", stages_s["growing"]);
  add("    light, and what bounces", stages_s["lighting"] + stages_s["bouncing light"]);
  add("    the model", stages_s["modelling"]);
  add("    the picture", stages_s["drawing"]);
  add("    all of it", run.run.total_s);
}

}  // namespace

void benchBolt(Report& report) {
  report.title("12. A bolt of lightning by its attractors: scene lightning, one run each");
  for (const int count : {250, 1000, 4000, 16'000}) benchBoltOf(count, report);
}

}  // namespace espalier::bench
