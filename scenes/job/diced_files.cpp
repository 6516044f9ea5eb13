#include "scenes/job/diced_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <ostream>

#include "render/files/diced_files.h"
#include "render/model/diced.h"
#include "scenes/show/voxel_colours.h"
#include "sim/base/error.h"
#include "sim/base/memory.h"

namespace espalier::scenes {
namespace {

constexpr const char *kDicedGlb = "diced.glb", *kDicedObj = "diced.obj";

using TakeUncut = std::function<void(const render::Uncut& uncut, sim::PartKind kind)>;

void forEachOfScene(const Site& site, const TakeUncut& take) {
  for (const sim::Mesh* mesh : meshesOf(site))
    take(render::uncut(*mesh, site.world.frame()), sim::PartKind::scene);
}

void forEachOfPlants(const ModelSources& sources, const TakeUncut& take) {
  const sim::Frame& frame = sources.site.world.frame();
  modelsFrom(sources, 0, false)([&](const render::PlantModel& plant) {
    take(render::uncut(plant.stems, frame), sim::PartKind::stem);
    take(render::uncut(plant.stalks, frame), sim::PartKind::stem);
    for (const render::ModelMesh& element : plant.elements)
      take(render::uncut(element, frame), sim::PartKind::element);
  });
}

/// Bytes for a mesh in so many files at once. Throws InputError where there are not as many.
double requireFits(const render::Uncut& mesh, const Site& site, const ModelsWanted& wanted) {
  const std::size_t fragments = render::fragmentsOf(mesh, site.world.frame().size);
  const double bytes = render::dicedBytes(fragments) * static_cast<double>(dicedFileNames(wanted).size());
  const double free = std::max(0.0, sim::memoryBudget() - sim::memoryInUse());
  if (bytes <= free) return bytes;
  throw sim::InputError(fmt::format(
      "mesh '{}': cut to the grid of voxels it has {} fragments, which need {} of memory, and {} are "
      "free for it here; expected larger voxels, or models that are not diced",
      mesh.name, fragments, sim::inGigabytes(bytes), sim::inGigabytes(free)));
}

render::DicedMeshes dicedFrom(const ModelSources& sources, std::shared_ptr<const VoxelColours> colours) {
  return [sources, colours = std::move(colours)](const std::function<void(const render::DicedMesh&)>& take) {
    const auto dice = [&](const render::Uncut& uncut, sim::PartKind kind) {
      take(render::diced(uncut, sources.site.world.frame(),
                         [&](sim::Voxel voxel) { return colours->at(voxel, kind); }));
    };
    forEachOfScene(sources.site, dice);
    forEachOfPlants(sources, dice);
  };
}

}  // namespace

double dicedBytes(const ModelsWanted& wanted, const Site& site) {
  double most = 0.0;
  if (!wanted.diced) return most;
  forEachOfScene(site, [&](const render::Uncut& uncut, sim::PartKind) {
    most = std::max(most, requireFits(uncut, site, wanted));
  });
  return most;
}

std::vector<std::string> dicedFileNames(const ModelsWanted& wanted) {
  if (!wanted.diced) return {};
  std::vector<std::string> names{kDicedGlb};
  if (wanted.obj) names.emplace_back(kDicedObj);
  return names;
}

std::vector<OutputFile> dicedFiles(const ModelsWanted& wanted, const ModelSources& sources) {
  if (!wanted.diced) return {};
  // The scene's own were asked about before anything grew (dicedBytes).
  forEachOfPlants(
      sources, [&](const render::Uncut& uncut, sim::PartKind) { requireFits(uncut, sources.site, wanted); });
  const auto meshes =
      dicedFrom(sources, std::make_shared<const VoxelColours>(sources.site.world, sources.bare, sources.light,
                                                              sources.lit, *wanted.diced, sources.to_sun));
  const auto light =
      *wanted.diced == ImageKind::first_pass ? render::DicedLight::given : render::DicedLight::wanted;
  std::vector<OutputFile> files;
  files.push_back({kDicedGlb, [meshes, light, &made_by = sources.made_by](std::iostream& out) {
                     render::writeDicedGlb(out, meshes, light, made_by);
                   }});
  if (!wanted.obj) return files;
  files.push_back({kDicedObj, [meshes, &made_by = sources.made_by](std::ostream& out) {
                     render::writeDicedObj(out, meshes, made_by);
                   }});
  return files;
}

}  // namespace espalier::scenes
