#include "scenes/expose.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/vdb.h"
#include "scenes/expose_pictures.h"
#include "scenes/exposure_table.h"
#include "scenes/job.h"
#include "scenes/light_fields.h"
#include "scenes/lighting.h"
#include "scenes/output_files.h"
#include "scenes/pictures.h"
#include "scenes/stages.h"
#include "sim/band.h"
#include "sim/error.h"

namespace espalier::scenes {
namespace {

std::shared_ptr<const sim::VoxelSet> spaceWanted(const sim::World& world, const ExposureSpec& spec) {
  switch (spec.where) {
    case ExposureWhere::surfaces:
      return nullptr;
    case ExposureWhere::band:
      return std::make_shared<const sim::VoxelSet>(
          sim::freeBand(world.occupied(), spec.band_vx, world.occupied()));
    case ExposureWhere::everything:
      break;
  }
  return std::make_shared<const sim::VoxelSet>(sim::freeVoxels(world.occupied()));
}

}  // namespace

ExposeResult exposeScene(Scene scene, const RunOptions& options) {
  ExposeResult result;
  Report& report = result.report;
  Stages stages(options, report);
  scene.world.layers = 0;  // nothing grows, so nothing needs to feel its way
  Job job = stages.run("tiling", [&] { return prepareJob(std::move(scene)); });
  describeWorld(report, job);

  std::shared_ptr<const sim::VoxelSet> space;
  const Lighting light = stages.run("lighting", [&] {
    space = spaceWanted(job.world, job.scene.exposure);
    LightWanted wanted;
    wanted.brightest = true;
    wanted.space = space;
    wanted.space_hours = true;
    return lightOf(job.world, job.sky, job.sun, wanted);
  });
  if (light.surfaces.empty() && !space) {
    throw sim::InputError(fmt::format(
        "{}: the world has no surface that can be lit; expected a mesh, or exposure: {{where: everything}}",
        job.scene.file.string()));
  }
  report.light = light.about;
  report.exposure = {light.surfaces.size(), light.sideless->count(), space ? space->count() : 0};

  const ExposureTable table = stages.run("counting", [&] { return exposureTable(job, light); });
  result.table = toText(table);
  std::vector<OutputFile> files = {
      {"exposure.csv", [&] { return toCsv(table); }},
      {"exposure.json", [&] { return toJson(table); }},
      {"exposure.vdb", [&] { return render::fieldVdbBytes(job.world, exposureFields(light, space.get())); }}};
  const sim::Growth nothing;
  const std::vector<render::PlantModel> no_models;
  if (options.pictures) {
    stages.run("drawing", [&] {
      if (job.scene.cameras.empty()) {
        const double aspect = static_cast<double>(job.scene.image_width) / job.scene.image_height;
        job.scene.cameras.push_back(overview(job.world, job.sun, aspect));
      }
      job.scene.images = exposureImages(job.scene, job.sun);
      for (OutputFile& file : drawPictures({job, nothing, light, no_models}, options.stop))
        files.push_back(std::move(file));
    });
  }
  stages.run("writing", [&] { writeAll(options.folder, files); });
  writeReport(options.folder, files, report);
  return result;
}

std::string summary(const ExposeResult& result, const std::filesystem::path& folder) {
  const Report& report = result.report;
  const auto& size = report.frame.size;
  std::string text = fmt::format("{}: {} x {} x {} voxels of {:.4g} m; {} surface voxels", report.scene,
                                 size.x, size.y, size.z, report.frame.voxel_m, report.exposure->surfaces);
  if (report.exposure->in_space > 0) text += fmt::format(", {} in free space", report.exposure->in_space);
  text += "\n";
  for (const auto& [name, about] : report.light) {
    if (name == "sky" || name == "sun") text += fmt::format("{}: {}\n", name, about);
  }
  text += "\n" + result.table + "\n";
  if (report.exposure->sideless > 0) {
    text += fmt::format("note: {} voxels have no side to be judged by and are not in the table\n",
                        report.exposure->sideless);
  }
  return text + endOfSummary(report, folder);
}

}  // namespace espalier::scenes
