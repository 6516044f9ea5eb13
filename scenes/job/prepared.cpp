#include "scenes/job/prepared.h"

#include "scenes/job/film.h"
#include "scenes/job/warnings.h"
#include "scenes/made/pieces_made.h"
#include "scenes/prepare/front_warnings.h"
#include "scenes/prepare/shut_out.h"
#include "scenes/prepare/unknown_regions.h"
#include "scenes/show/cube_pictures.h"
#include "scenes/show/cut_out_picture.h"

namespace espalier::scenes {

Plans plansOn(const Scene& scene, const Site& site, const RunOptions& options) {
  Plans plans;
  std::vector<Problem> of_attractors;
  Gathering wrong(scene.file);
  wrong.part([&] { plans.plantings = makePlantings(scene, site); });
  wrong.part([&] { requireCamerasInTheOpen(scene, site.world); });
  wrong.part([&] { requireLampsInTheOpen(scene, site); });
  wrong.part([&] { requireCubesSeen(scene, site.world.frame()); });
  wrong.part([&] { requireCutOutsSeen(scene, site.meshes); });
  wrong.part([&] { requirePiecesSound(scene, site); });
  wrong.part([&] { requireFilmFitsIn(scene, options, site.world); });
  wrong.part([&] { plans.attractors = attractorsOf(scene, site, &of_attractors); });
  wrong.end();
  for (NamedPoints& crown : crownsOf(scene, site, plans.plantings, &of_attractors))
    plans.attractors.push_back(std::move(crown));
  plans.seed_lights = lightOfSeeds(plans.plantings, site.world, growthSettings(scene, site, {}).light);
  plans.warnings = scene.warnings;
  for (const auto& more :
       {site.warnings, of_attractors, frontWarnings(scene, site.world.frame(), plans.attractors),
        shutOutWarnings(scene, site, plans.plantings), unknownRegions(scene, site.world),
        filmWarnings(scene, options)})
    plans.warnings.insert(plans.warnings.end(), more.begin(), more.end());
  return plans;
}

Prepared prepare(const Scene& scene, const RunOptions& options, Report& report, Stages& stages) {
  Prepared prepared = stages.run("tiling", [&] {
    Site site = makeSite(scene);
    Plans plans = plansOn(scene, site, options);
    return Prepared{std::move(plans), std::move(site)};
  });
  describeWorld(report, scene, prepared.site);
  warn(prepared.warnings, scene.file, options, report);
  return prepared;
}

}  // namespace espalier::scenes
