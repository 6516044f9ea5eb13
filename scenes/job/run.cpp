#include "scenes/job/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <span>

#include "render/files/skeleton_json.h"
#include "render/files/vdb.h"
#include "render/image/image_io.h"
#include "render/model/plant_model.h"
#include "rules/growth/rule_book.h"
#include "scenes/foretell/foretell.h"
#include "scenes/job/diced_files.h"
#include "scenes/job/fed.h"
#include "scenes/job/film.h"
#include "scenes/job/plant_models.h"
#include "scenes/job/plant_reports.h"
#include "scenes/job/prepared.h"
#include "scenes/job/run_light.h"
#include "scenes/job/run_pieces.h"
#include "scenes/job/saved_growth.h"
#include "scenes/job/shown.h"
#include "scenes/job/stages.h"
#include "scenes/lights.h"
#include "scenes/made/heights.h"
#include "scenes/prepare/in_scene.h"
#include "scenes/prepare/plantings.h"
#include "scenes/prepare/site.h"
#include "scenes/problem.h"
#include "scenes/show/emitted_light.h"
#include "scenes/show/guide_volumes.h"
#include "scenes/show/light_fields.h"
#include "scenes/show/picture_memory.h"
#include "scenes/show/pictures.h"
#include "scenes/show/vines_picture.h"
#include "scenes/show/volume_picture.h"
#include "scenes/show/world_occupancy.h"
#include "scenes/write/output_folder.h"
#include "sim/base/counted.h"
#include "sim/base/parallel.h"
#include "sim/light/lighting.h"

namespace espalier::scenes {
namespace {

constexpr const char* kWorldFile = "world.vdb";

/// For pictures of what has grown on a site. Borrows all but the textures.
Finished finishedOn(const Scene& scene, const Site& site, const sim::BitVolume& bare, const Shown& shown,
                    const sim::Lighting& light, const PictureLight& lit,
                    const std::optional<WorldOccupancy>& occupancy,
                    const std::vector<render::PlantModel>& models, render::KnownPictures textures,
                    const RunPieces& pieces, std::span<const MadeHeights> heights) {
  return {site.meshes,
          site.world,
          bare,
          shown.growth(),
          light,
          models,
          std::move(textures),
          growthSettings(scene, site, {}).sky_table,
          lit,
          occupancy ? &*occupancy : nullptr,
          &pieces.shown,
          &shown.grown(),
          heights};
}

/// What light and files take besides: of each voxel some bits, and two numbers where there are vines to draw;
/// places before surfaces, as for a world whose sides are surfaces.
double laterBytes(sim::Vec3 size, bool vines) {
  const double voxels = size.x * size.y * size.z;
  const double sides = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
  return (vines ? 5.0 : 1.0) * voxels + 100.0 * sides;
}

/// What models, files and lighting take for each element, by its corners.
double laterAnElement(const std::vector<sim::Planting>& plantings) {
  constexpr double kBytesACorner = 150.0;
  std::size_t most = 0;
  for (const sim::Planting& planting : plantings) {
    for (const sim::ElementShape& shape : planting.process->seedling().shapes) {
      std::size_t corners = 0;
      for (const auto& polygon : shape.polygons) corners += polygon.size();
      most = std::max(most, corners);
    }
  }
  return kBytesACorner * static_cast<double>(most);
}

/// `drawn`: there are pictures of them.
std::vector<MadeHeights> heightsOf(const Scene& scene, const Site& site, const sim::Growth& growth,
                                   bool drawn, Stages& stages) {
  if (scene.heights.empty()) return {};
  return stages.run(
      "making", [&] { return makeHeights(scene, growth, site.world.frame(), drawn ? &site.sky : nullptr); });
}

PicturesWanted picturesAsked(const Scene& scene, const RunOptions& options) {
  return options.pictures ? picturesOf(scene) : PicturesWanted();
}

/// Grows from the beginning or from what was kept, and keeps every so many iterations what has grown.
sim::Growth growOn(const Scene& scene, Prepared& prepared, std::optional<sim::Growth> kept,
                   const sim::BitVolume& bare, const RunOptions& options, const OutputFolder& output,
                   const Keeping& keeping, Clock::time_point began, Report& report) {
  Site& site = prepared.site;
  std::vector<sim::Planting>& plantings = prepared.plantings;
  sim::GrowthSettings settings = growthSettings(scene, site, prepared.attractors);
  settings.progress = [&](const sim::GrowthProgress& progress) {
    report.run.proposals = progress.proposals;
    if (options.on_growth) options.on_growth(progress);
  };
  if (kept) {
    report.run.went_on_from = kept->iterations;
    if (kept->iterations > scene.iterations) {
      throw sim::InputError(fmt::format(
          "{}: it has grown for {}; expected at most the {} that are asked for",
          (options.folder / kStateFile).string(),
          sim::counted(static_cast<std::uint64_t>(kept->iterations), "iteration"), scene.iterations));
    }
  }
  const bool vines = (options.pictures && drawsVines(scene.images)) || films(scene, options);
  settings.memory.later_bytes =
      laterBytes(sim::Vec3(site.world.frame().size), vines) +
      inScene(scene, scene.world.place, [&] { return dicedBytes(options.models, site); });
  // Stems and leaves as triangles, twice in memory while files are made; again for rays, where vines are
  // drawn.
  settings.memory.later_a_segment = vines ? 15'000.0 : 5'000.0;
  settings.memory.later_an_element = laterAnElement(plantings);
  const sim::Inputs inputs = keeping.every > 0 ? inputsOf(scene, site) : sim::Inputs();
  const std::unique_ptr<sim::Growing> growing =
      kept ? goOnFrom(std::move(*kept), options.folder, site.world, plantings, settings)
           : inScene(scene, [&] { return beginGrowth(scene, site, plantings, settings); });
  std::optional<GrowthForeteller> foreteller;
  if (options.on_foretold)
    foreteller.emplace(site, plantings, picturesAsked(scene, options), scene.iterations, growing->growth(),
                       began);
  for (bool over = false; !over;) {
    over = !growing->step();
    const sim::Growth& now = growing->growth();
    if (!over && keeping.every > 0 && now.iterations % keeping.every == 0)
      output.write(
          {{kStateFile, [&](std::ostream& out) { sim::writeState(out, inputs, site.world, bare, now); }}});
    if (!foreteller) continue;
    report.run.foretold = foreteller->after(now, over);
    if (!report.run.foretold) continue;
    options.on_foretold(*report.run.foretold);
    foreteller.reset();
  }
  return growing->take();
}

/// Whether models have pictures on them that the program draws: pictures or not, its drawing module is
/// needed.
bool drawsTextures(const Scene& scene) {
  return std::any_of(scene.plants.begin(), scene.plants.end(), [](const PlantSpec& plant) {
    bool draws = false;
    rules::forEachSet(*plant.rules, [&](const rules::RuleSet& set, const std::string&) {
      const auto drawn = [](const std::string& texture, const auto& picture) {
        return !texture.empty() && picture == nullptr;
      };
      draws = draws || drawn(set.stem.texture, set.stem.picture) ||
              std::any_of(set.elements.begin(), set.elements.end(),
                          [&](const rules::Element& e) { return drawn(e.texture, e.picture); });
    });
    return draws;
  });
}

}  // namespace

Report runScene(const Scene& scene, const RunOptions& options, const Keeping& keeping) {
  if (!scene.asks.empty()) return runScene(fed(scene, options.folder, options).scene, options, keeping);
  if (options.pictures) requirePicturesFit(scene, picturesOf(scene));
  requireFilmFits(scene, options);
  std::vector<std::string> names = modelFileNames(options.models);
  for (std::string& name : dicedFileNames(options.models)) names.push_back(std::move(name));
  names.insert(names.end(), {kSkeletonFile, kWorldFile, kReportFile});
  for (std::string& name : piecesFileNames(scene)) names.push_back(std::move(name));
  for (std::string& name : heightFileNames(scene)) names.push_back(std::move(name));
  if (keeping.keep || keeping.every > 0) names.emplace_back(kStateFile);
  if (options.pictures) {
    for (std::string& name : fileNames(scene.images)) names.push_back(std::move(name));
  }
  addFilmFileNames(scene, options, names);
  if (options.pictures || drawsTextures(scene)) render::makeReadyToDraw();
  OutputFolder output(options.folder, std::move(names), scene.read_paths);
  Report report;
  Stages stages(options, report);
  Prepared prepared = prepare(scene, options, report, stages);
  output.protect(prepared.site.mesh_paths);
  Site& site = prepared.site;
  const sim::BitVolume bare = site.world.occupied();
  // Plants grow in the site's own world: a run grows once, and a second world would take as much memory.
  sim::World& world = site.world;

  std::optional<sim::World> before = worldToForm(site, prepared.plantings);
  std::optional<sim::Growth> kept;
  if (keeping.resume) {
    stages.run("reading", [&] {
      if (auto state = readKept(options.folder)) {
        kept = takeUp(std::move(*state), options.folder, scene, site, prepared.plantings, Same::everything);
      }
    });
  }
  sim::Growth grown = stages.run("growing", [&] {
    return growOn(scene, prepared, std::move(kept), bare, options, output, keeping, stages.began(), report);
  });
  report.growth = growthReport(scene, site, bare, grown, prepared.seed_lights);
  const Shown shown(std::move(grown), std::move(before), site, stages);
  const sim::Growth& growth = shown.growth();
  if (scene.interreflection) letBeMet(site.world, growth.plants);
  if (!growth.cut_short.empty()) report.warnings.push_back(growth.cut_short);
  for (const std::string& met : report.growth->in_the_way) report.warnings.push_back(met);
  report.occupied_voxels = world.occupied().count();

  std::shared_ptr<const sim::VoxelSet> layers;
  std::optional<WorldOccupancy> occupancy;
  sim::Lighting light = stages.run("lighting", [&] {
    layers = std::make_shared<const sim::VoxelSet>(openLayers(bare, world));
    occupancy.emplace(scene, site.meshes, world, bare, growth.plants);
    return lightFor(scene, site, options.pictures ? scene.images : std::vector<ImageSpec>(), bare, layers,
                    options.models);
  });
  const PictureLight lit =
      litFor(scene, site, growth.plants, light, picturesAsked(scene, options), options.models, stages);
  report.light = light.about;
  std::vector<render::PlantModel> models;  // for pictures; else they are made while they are written
  if (options.pictures)
    models = stages.run("modelling", [&] { return modelPlants(world.frame(), growth.plants, bare); });
  const GuideVolumes guides = inScene(scene, [&] { return guideVolumes(growth, usedFields(scene), world); });
  for (const render::VdbField& field : guides.fields)
    report.growth->fields.push_back({field.name, guides.near->count()});
  const std::vector<MadeHeights> heights = heightsOf(scene, site, shown.grown(), options.pictures, stages);
  const ModelSources sources{site,           growth.plants, bare, models,
                             report.made_by, light,         lit,  shadowDirection(scene.sun)};
  std::vector<OutputFile> files =
      modelFiles(options.models, sources, [&](std::size_t plant, const render::PlantModel& model) {
        report.growth->plants[plant].meeting_limbs = model.meeting_limbs;
        report.growth->plants[plant].triangles = render::triangleCount(model);
      });
  for (OutputFile& file : inScene(scene, [&] { return dicedFiles(options.models, sources); }))
    files.push_back(std::move(file));
  for (OutputFile& file : heightFiles(heights, report.made_by)) files.push_back(std::move(file));
  files.push_back({kSkeletonFile, [&](std::ostream& out) {
                     render::writeSkeletons(out, growth.plants, world.frame(), report.made_by);
                   }});
  files.push_back({kWorldFile, [&](std::ostream& out) {
                     std::vector<render::VdbField> fields = worldFields(light, *layers);
                     fields.insert(fields.begin(), occupancy->alpha());
                     fields.insert(fields.end(), guides.fields.begin(), guides.fields.end());
                     render::writeVdb(out, world, fields, report.made_by);
                   }});
  if (keeping.keep) {
    files.push_back({kStateFile, [&](std::ostream& out) {
                       sim::writeState(out, inputsOf(scene, site), shown.grownWorld(), bare, shown.grown());
                     }});
  }
  std::vector<std::string> late_warnings;
  if (!growth.cut_short.empty()) late_warnings.push_back(growth.cut_short);
  const RunPieces pieces =
      cutPieces(scene, site, growth, scene.images, options, report, stages, late_warnings);
  addPiecesFiles(pieces, report.made_by, files);
  ReadTextures textures;
  if (options.pictures) {
    stages.run("drawing", [&] {
      textures = texturesFor(drawsVines(scene.images) || scene.film, scene, site.meshes, options, report);
      for (const Problem& unread : textures.unread) late_warnings.push_back(unread.text);
      const Finished finished = finishedOn(scene, site, bare, shown, light, lit, occupancy, models,
                                           textures.pictures, pieces, heights);
      auto pictures =
          inScene(scene, [&] { return drawPictures(picturesOf(scene, report.made_by), finished); });
      for (OutputFile& file : pictures) files.push_back(std::move(file));
    });
  }
  if (films(scene, options)) {
    stages.run("filming", [&] {
      addFilm({scene, site, bare, growth, light, lit, textures.pictures, report.made_by}, options, files,
              report, late_warnings);
    });
  }
  stages.run("writing", [&] {
    output.write(files);
    if (!keeping.keep) dropState(options.folder);
    if (films(scene, options)) dropOldFilm(options.folder, files);
  });
  writeReport(output, files, report);
  requireNone(late_warnings, scene.file, options);
  return report;
}

Foretold foretellRun(const Scene& scene, const RunOptions& options,
                     const std::function<void(const Site& site)>& look) {
  if (!scene.asks.empty()) return foretellRun(FedInPassing(scene, options).scene(), options, look);
  const PicturesWanted pictures = picturesAsked(scene, options);
  if (options.pictures) requirePicturesFit(scene, pictures);
  requireFilmFits(scene, options);
  Report report;
  Stages stages(options, report);
  Prepared prepared = prepare(scene, options, report, stages);
  Site& site = prepared.site;
  if (look) look(site);
  const std::unique_ptr<sim::Growing> growing =
      beginGrowth(scene, site, prepared.plantings, growthSettings(scene, site, prepared.attractors));
  std::optional<Foretold> foretold;
  inScene(scene, [&] {
    GrowthForeteller foreteller(site, prepared.plantings, pictures, scene.iterations, growing->growth(),
                                stages.began());
    while (!foretold) {
      const bool over = !growing->step();
      foretold = foreteller.after(growing->growth(), over);
    }
  });
  texturesFor((options.pictures && drawsVines(scene.images)) || films(scene, options), scene, site.meshes,
              options, report);
  return *foretold;
}

Report renderScene(Scene scene, const std::filesystem::path& from, const RunOptions& options) {
  FedScene fed_scene;
  if (!scene.asks.empty()) {
    fed_scene = fed(scene, from, options);
    scene = std::move(fed_scene.scene);
  }
  if (scene.images.empty() && !scene.film) {
    throw sim::InputError(
        fmt::format("{}: it has no images to draw; expected at least one, or a film", scene.file.string()));
  }
  requirePicturesFit(scene, picturesOf(scene));
  requireFilmFits(scene, options);
  render::makeReadyToDraw();
  std::vector<std::string> names = fileNames(scene.images);
  addFilmFileNames(scene, options, names);
  OutputFolder output(options.folder, std::move(names), scene.read_paths);
  Report report;
  Stages stages(options, report);
  std::optional<sim::State> state = stages.run("reading", [&] { return readKept(from); });
  if (!state) {
    throw sim::InputError(fmt::format("{}: there is no {}; expected the output folder of espalier grow",
                                      from.string(), kStateFile));
  }
  // Strewn seeds and random rays lie where they lay.
  scene.seed = seedOf(*state).value_or(scene.seed);
  Prepared prepared = prepare(scene, options, report, stages);
  output.protect(prepared.site.mesh_paths);
  Site& site = prepared.site;
  const sim::BitVolume bare = site.world.occupied();
  std::optional<sim::World> before = worldToForm(site, prepared.plantings);
  sim::Growth grown = takeUp(std::move(*state), from, scene, site, prepared.plantings, Same::plants);
  report.growth = growthReport(scene, site, bare, grown, prepared.seed_lights);
  const Shown shown(std::move(grown), std::move(before), site, stages);
  const sim::Growth& growth = shown.growth();
  if (scene.interreflection) letBeMet(site.world, growth.plants);
  report.occupied_voxels = site.world.occupied().count();
  std::optional<WorldOccupancy> occupancy;
  sim::Lighting light = stages.run("lighting", [&] {
    if (options.on_foretold) {
      report.run.foretold = foretellPictures(site, prepared.plantings, grownIn(growth.plants),
                                             picturesOf(scene), stages.began());
      options.on_foretold(*report.run.foretold);
    }
    if (drawsVolumes(scene.images)) occupancy.emplace(scene, site.meshes, site.world, bare, growth.plants);
    return lightFor(scene, site, scene.images, bare, nullptr);
  });
  const PictureLight lit = litFor(scene, site, growth.plants, light, picturesOf(scene), {}, stages);
  report.light = light.about;
  const auto models =
      stages.run("modelling", [&] { return modelPlants(site.world.frame(), growth.plants, bare); });
  const std::vector<MadeHeights> heights = heightsOf(scene, site, shown.grown(), true, stages);
  std::vector<std::string> late_warnings;
  const RunPieces pieces =
      cutPieces(scene, site, growth, scene.images, options, report, stages, late_warnings);
  ReadTextures textures;
  std::vector<OutputFile> files = stages.run("drawing", [&] {
    textures = texturesFor(drawsVines(scene.images) || scene.film, scene, site.meshes, options, report);
    for (const Problem& one : textures.unread) late_warnings.push_back(one.text);
    const Finished finished = finishedOn(scene, site, bare, shown, light, lit, occupancy, models,
                                         textures.pictures, pieces, heights);
    return inScene(scene, [&] { return drawPictures(picturesOf(scene, report.made_by), finished); });
  });
  if (scene.film) {
    stages.run("filming", [&] {
      addFilm({scene, site, bare, growth, light, lit, textures.pictures, report.made_by}, options, files,
              report, late_warnings);
    });
  }
  stages.run("writing", [&] {
    output.write(files);
    if (scene.film) dropOldFilm(options.folder, files);
  });
  finishReport(files, report);
  requireNone(late_warnings, scene.file, options);
  return report;
}

}  // namespace espalier::scenes
