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

Prepared prepare(const Scene& scene, const RunOptions& options, Report& report, Stages& stages) {
  std::vector<Problem> of_attractors;
  Prepared prepared = stages.run("tiling", [&] {
    Site site = makeSite(scene);
    std::vector<sim::Planting> plantings;
    std::vector<NamedPoints> attractors;
    Gathering wrong(scene.file);
    wrong.part([&] { plantings = makePlantings(scene, site); });
    wrong.part([&] { requireCamerasInTheOpen(scene, site.world); });
    wrong.part([&] { requireLampsInTheOpen(scene, site); });
    wrong.part([&] { requireCubesSeen(scene, site.world.frame()); });
    wrong.part([&] { requireCutOutsSeen(scene, site.meshes); });
    wrong.part([&] { requirePiecesSound(scene, site); });
    wrong.part([&] { requireFilmFitsIn(scene, options, site.world); });
    wrong.part([&] { attractors = attractorsOf(scene, site, &of_attractors); });
    wrong.end();
    for (NamedPoints& crown : crownsOf(scene, site, plantings, &of_attractors))
      attractors.push_back(std::move(crown));
    auto lights = lightOfSeeds(plantings, site.world, growthSettings(scene, site, {}).light);
    return Prepared{std::move(site), std::move(plantings), std::move(attractors), std::move(lights)};
  });
  describeWorld(report, scene, prepared.site);
  std::vector<Problem> warnings = scene.warnings;
  for (const auto& more : {prepared.site.warnings, of_attractors,
                           frontWarnings(scene, prepared.site.world.frame(), prepared.attractors),
                           shutOutWarnings(scene, prepared.site, prepared.plantings),
                           unknownRegions(scene, prepared.site.world), filmWarnings(scene, options)})
    warnings.insert(warnings.end(), more.begin(), more.end());
  warn(warnings, scene.file, options, report);
  return prepared;
}

}  // namespace espalier::scenes
