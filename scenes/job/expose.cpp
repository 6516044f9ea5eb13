#include "scenes/job/expose.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "render/files/vdb.h"
#include "render/image/image_io.h"
#include "scenes/accuracy/certificate.h"
#include "scenes/foretell/foretell.h"
#include "scenes/job/fed.h"
#include "scenes/job/run_light.h"
#include "scenes/job/stages.h"
#include "scenes/job/warnings.h"
#include "scenes/lights.h"
#include "scenes/prepare/in_scene.h"
#include "scenes/prepare/site.h"
#include "scenes/show/expose_pictures.h"
#include "scenes/show/exposure_table.h"
#include "scenes/show/light_fields.h"
#include "scenes/show/picture_memory.h"
#include "scenes/show/pictures.h"
#include "scenes/write/output_folder.h"
#include "sim/base/counted.h"
#include "sim/light/lighting.h"
#include "sim/light/surface.h"
#include "sim/world/band.h"

namespace espalier::scenes {
namespace {

constexpr const char *kTable = "exposure.csv", *kTableJson = "exposure.json", *kFields = "exposure.vdb";

std::shared_ptr<const sim::VoxelSet> spaceWanted(const sim::World& world, const ExposureSpec& spec) {
  switch (spec.where) {
    case ExposureWhere::surfaces:
      return nullptr;
    case ExposureWhere::band:
      return std::make_shared<const sim::VoxelSet>(sim::freeBand(world, world.occupied(), spec.band_vx));
    case ExposureWhere::everything:
      break;
  }
  return std::make_shared<const sim::VoxelSet>(sim::freeVoxels(world));
}

/// Each free voxel takes two bytes a field, four in its grid and four in the file, for three fields.
void requireSpaceFits(const Scene& scene, const sim::Frame& frame, const sim::VoxelSet& space) {
  constexpr double kBytes = 3 * (2 + 4 + 4);
  const double voxels = static_cast<double>(frame.size.x) * frame.size.y * frame.size.z;
  try {
    sim::requireFits(frame, {0, kBytes * static_cast<double>(space.count()) / voxels});
  } catch (const sim::InputError& error) {
    throw PlacedError(
        {problemAt(scene.exposure.place, scene.file,
                   fmt::format("{}, and so would less of its free space (exposure.where, exposure.band)",
                               error.what()))});
  }
}

/// The pictures of a scene's exposure, as far as they are known before anything is tiled: the overview's
/// camera is not. None unless they are drawn.
PicturesWanted exposurePictures(const Scene& scene, const RunOptions& options) {
  if (!options.pictures) return {};
  PicturesWanted wanted = picturesOf(scene);
  if (wanted.cameras.empty()) wanted.cameras.emplace_back();
  wanted.images = exposureImages(scene, wanted.cameras, true);
  requirePicturesFit(scene, wanted);
  return wanted;
}

Site exposureSite(const Scene& scene, const RunOptions& options, Report& report, Stages& stages) {
  Site site = stages.run("tiling", [&] {
    Site made = makeSiteForLight(scene);
    Gathering wrong(scene.file);
    wrong.part([&] { requireCamerasInTheOpen(scene, made.world); });
    wrong.part([&] { requireLampsInTheOpen(scene, made); });
    wrong.end();
    return made;
  });
  describeWorld(report, scene, site);
  warn(site.warnings, scene.file, options, report);
  return site;
}

/// Free voxels where light is wanted, or null. Throws where they do not fit, or nothing at all can be lit.
std::shared_ptr<const sim::VoxelSet> fittingSpace(const Scene& scene, const Site& site) {
  auto space = spaceWanted(site.world, scene.exposure);
  if (space) requireSpaceFits(scene, site.world.frame(), *space);
  if (!space && !sim::anyCanBeLit(site.world)) {
    throw PlacedError({problemAt(
        scene.world.place, scene.file,
        "the world has no surface that can be lit; expected a mesh that has a side and free space before it "
        "within world.bounds, or exposure: {where: everything}")});
  }
  return space;
}

}  // namespace

void requireExposable(const Scene& scene, const Site& site, const RunOptions& options) {
  Gathering wrong(scene.file);
  wrong.part([&] { exposurePictures(scene, options); });
  wrong.part([&] { fittingSpace(scene, site); });
  wrong.end();
}

Foretold foretellExpose(const Scene& scene, const RunOptions& options) {
  if (!scene.asks.empty()) return foretellExpose(FedInPassing(scene, options).scene(), options);
  Report report;
  Stages stages(options, report);
  const PicturesWanted pictures = exposurePictures(scene, options);
  const Site site = exposureSite(scene, options, report, stages);
  return foretellExposure(site, fittingSpace(scene, site).get(), pictures, stages.began());
}

Foretold foretellExpose(const Scene& scene, const RunOptions& options, const Site& site,
                        Clock::duration making) {
  return foretellExposure(site, fittingSpace(scene, site).get(), exposurePictures(scene, options),
                          Clock::now() - making);
}

ExposeResult exposeScene(const Scene& scene, const RunOptions& options) {
  if (!scene.asks.empty()) return exposeScene(fed(scene, options.folder, options).scene, options);
  ExposeResult result;
  Report& report = result.report;
  Stages stages(options, report);
  std::vector<std::string> names = {kTable, kTableJson, kFields};
  const PicturesWanted pictures = exposurePictures(scene, options);
  for (std::string& name : fileNames(pictures.images)) names.push_back(std::move(name));
  names.emplace_back(kReportFile);
  if (options.pictures) render::makeReadyToDraw();
  OutputFolder output(options.folder, std::move(names), scene.read_paths);
  const Site site = exposureSite(scene, options, report, stages);
  output.protect(site.mesh_paths);

  std::shared_ptr<const sim::VoxelSet> space;
  sim::Lighting light = stages.run("lighting", [&] {
    space = fittingSpace(scene, site);
    if (options.on_foretold) {
      report.run.foretold = foretellExposure(site, space.get(), pictures, stages.began());
      options.on_foretold(*report.run.foretold);
    }
    sim::LightWanted wanted;
    wanted.brightest = true;
    wanted.space = space;
    wanted.space_hours = true;
    wanted.random_sky = site.random_sky;
    if (scene.interreflection && options.pictures) wanted.to_sun = shadowDirection(scene.sun);
    return sim::lightOf(site.world, site.sky, site.sun, wanted);
  });
  const PictureLight lit = litFor(scene, site, {}, light, pictures, {}, stages);
  report.light = light.about;
  report.exposure = {light.surfaces.size(), light.gaps->count(), space ? space->count() : 0};

  if (!site.random_sky && !light.surfaces.empty())
    report.certificate = stages.run("certifying", [&] { return certify(site, light, scene.seed); });
  const ExposureTable table = stages.run("counting", [&] {
    return exposureTable(scene.name, site.world, light, scene.sun.north_deg, scene.exposure.unreached);
  });
  result.table = toText(table);
  std::vector<OutputFile> files = {
      fileOf(kTable, [&] { return toCsv(table); }),
      fileOf(kTableJson, [&] { return toJson(table); }),
      {kFields, [&](std::ostream& out) {
         render::writeFieldVdb(out, site.world, exposureFields(light, space.get()), report.made_by);
       }}};
  const sim::Growth no_growth;
  const std::vector<render::PlantModel> no_models;
  if (options.pictures) {
    stages.run("drawing", [&] {
      PicturesWanted wanted = picturesOf(scene, report.made_by);
      if (wanted.cameras.empty()) {
        const double aspect = static_cast<double>(wanted.width_px) / wanted.height_px;
        wanted.cameras.push_back(overview(site.world.frame(), light.surfaces, site.sun, aspect));
      }
      wanted.images = exposureImages(scene, wanted.cameras, !site.sun.directions.empty());
      const Finished finished{site.meshes, site.world, site.world.occupied(), no_growth, light, no_models, {},
                              {},          lit};
      auto drawn = inScene(scene, [&] { return drawPictures(wanted, finished); });
      for (OutputFile& file : drawn) files.push_back(std::move(file));
    });
  }
  stages.run("writing", [&] { output.write(files); });
  writeReport(output, files, report);
  return result;
}

std::string summary(const ExposeResult& result, const std::filesystem::path& folder) {
  const Report& report = result.report;
  const auto& size = report.frame.size;
  std::string text = fmt::format("{}: {} x {} x {} voxels of {:.4g} m; {} surface voxels", report.scene,
                                 size.x, size.y, size.z, report.frame.voxel_m, report.exposure->surfaces);
  if (report.exposure->in_space > 0) text += fmt::format(", {} in free space", report.exposure->in_space);
  text += "\n";
  text += "sky: " + report.light.sky + "\n";
  if (!report.light.sun.empty()) text += report.light.sun + "\n";
  text += "\n" + result.table + "\n";
  if (report.certificate) text += inShort(*report.certificate);
  if (report.exposure->gaps > 0) {
    text += fmt::format("note: not in the table: {} deep in corners or gaps, without a place in front\n",
                        sim::counted(report.exposure->gaps, "voxel"));
  }
  return text + endOfSummary(report, folder);
}

}  // namespace espalier::scenes
