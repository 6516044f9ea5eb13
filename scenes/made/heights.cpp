#include "scenes/made/heights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/files/gltf.h"
#include "render/image/image_io.h"
#include "scenes/made/heights_mesh.h"
#include "scenes/prepare/in_scene.h"
#include "sim/base/counted.h"
#include "sim/base/error.h"
#include "sim/base/memory.h"
#include "sim/base/random.h"
#include "sim/light/lighting.h"
#include "sim/tile/build_world.h"

namespace espalier::scenes {
namespace {

constexpr double kSamples = 1000.0;      // along the longer side, where the scene does not say
constexpr double kDrawnVoxels = 360.0;   // likewise, of the world that pictures are lit in
constexpr double kBytesASample = 350.0;  // of mesh, texture and files

/// The lines of a planting's skeletons in plan, of what stood after so many iterations.
sim::PlanLines linesOf(const sim::Growth& growth, const sim::Stand& stand, const sim::Frame& frame,
                       const std::optional<int>& iteration) {
  sim::PlanLines lines;
  for (std::size_t p = stand.first; p < stand.first + stand.count; ++p) {
    const sim::Skeleton& skeleton = growth.plants[p].skeleton;
    std::vector<std::int32_t> number(skeleton.parent.size(), -1);
    for (std::size_t n = 0; n < number.size(); ++n) {
      const sim::NodeId parent = skeleton.parent[n];
      if (parent != sim::kNoNode && iteration && skeleton.born[n] >= *iteration) continue;
      number[n] = static_cast<std::int32_t>(lines.parent.size());
      lines.parent.push_back(parent == sim::kNoNode ? -1 : number[static_cast<std::size_t>(parent)]);
      const sim::Vec3 at_m = sim::worldFromVoxel(frame, skeleton.position_vx[n]);
      lines.at_m.emplace_back(at_m.x, at_m.z);
    }
  }
  return lines;
}

sim::HeightRaster rasterOf(const HeightsSpec& spec, const sim::Frame& frame) {
  const sim::Vec3 end_m = sim::worldFromVoxel(frame, sim::Vec3(frame.size));
  glm::dvec2 low(frame.origin_m.x, frame.origin_m.z), high(end_m.x, end_m.z);
  if (!spec.over_m.empty()) {
    low = glm::min(spec.over_m[0], spec.over_m[1]);
    high = glm::max(spec.over_m[0], spec.over_m[1]);
  }
  const glm::dvec2 size = high - low;
  const double longer = std::max(size.x, size.y);
  sim::HeightRaster raster;
  raster.low_m = low;
  raster.spacing_m = spec.spacing_m > 0.0 ? spec.spacing_m : longer / kSamples;
  const glm::dvec2 samples = glm::floor(size / raster.spacing_m + 1e-6) + 1.0;
  const double bytes = samples.x * samples.y * kBytesASample;
  const double left = std::max(0.0, sim::memoryBudget() - sim::memoryInUse());
  if (bytes > left || samples.x * samples.y > 4e9) {
    throw sim::InputError(fmt::format(
        "heights of {:.0f} x {:.0f} samples take {} of memory, and {} are left; expected a spacing of at "
        "least {:.2g} m",
        samples.x, samples.y, sim::inGigabytes(bytes), sim::inGigabytes(left),
        1.1 * raster.spacing_m * std::sqrt(bytes / std::max(left, 1e6))));
  }
  if (samples.x < 2.0 || samples.y < 2.0) {
    throw sim::InputError(
        fmt::format("a spacing of {} m leaves {:.0f} x {:.0f} samples of land of {} m x {} m; "
                    "expected at most {:.3g} m",
                    raster.spacing_m, samples.x, samples.y, size.x, size.y, std::min(size.x, size.y)));
  }
  raster.wide = static_cast<int>(samples.x);
  raster.deep = static_cast<int>(samples.y);
  return raster;
}

void requireMemory(double bytes) {
  const double left = sim::memoryBudget() - sim::memoryInUse();
  if (bytes <= left) return;
  throw sim::InputError(
      fmt::format("these heights take {} of memory, and {} are left; expected a larger spacing, or noise and "
                  "meanders of a larger scale",
                  sim::inGigabytes(bytes), sim::inGigabytes(std::max(0.0, left))));
}

/// Lines that never come over the land have no outlet there.
void requireLines(const HeightsSpec& spec, const sim::PlanLines& lines, const sim::HeightRaster& raster) {
  std::size_t segments = 0, over = 0;
  for (std::size_t n = 0; n < lines.parent.size(); ++n) {
    if (lines.parent[n] < 0) continue;
    ++segments;
    over += raster.holds(raster.nearest(lines.at_m[n])) ||
            raster.holds(raster.nearest(lines.at_m[static_cast<std::size_t>(lines.parent[n])]));
  }
  if (segments == 0) {
    throw sim::InputError(fmt::format(
        "the plants {} have no line after {}; expected some that grew, so more iterations or attractors "
        "within reach of their seeds",
        spec.plants,
        spec.iteration ? sim::counted(static_cast<std::uint64_t>(*spec.iteration), "iteration")
                       : "all iterations"));
  }
  if (over == 0) {
    throw sim::InputError(
        fmt::format("no line of the plants {} comes over the land, from [{}, {}] to [{}, {}]: water would "
                    "have no outlet; "
                    "expected `over` where they grow",
                    spec.plants, raster.low_m.x, raster.low_m.y, raster.place(raster.wide - 1, 0).x,
                    raster.place(0, raster.deep - 1).y));
  }
}

void lightUp(MadeHeights& made, const sim::Sky& sky) {
  const sim::HeightRaster& raster = made.relief.raster;
  std::vector<sim::TiledMesh> tiled;
  for (const sim::Mesh& mesh : made.meshes) tiled.push_back({mesh});
  const double voxel_m =
      std::max(raster.spacing_m, raster.spacing_m * std::max(raster.wide, raster.deep) / kDrawnVoxels);
  auto world = std::make_shared<sim::World>(
      sim::buildWorld(sim::frameAround(tiled, voxel_m, 3.0 * voxel_m), tiled, 0));
  sim::LightWanted wanted;
  wanted.faces = false;
  wanted.dense = true;
  made.sky = sim::lightOf(*world, sky, {}, wanted).space_sky;
  made.world = std::move(world);
}

MadeHeights makeOne(const Scene& scene, const HeightsSpec& spec, const sim::Growth& growth,
                    const sim::Frame& frame) {
  const auto planting = std::find_if(scene.plants.begin(), scene.plants.end(),
                                     [&](const PlantSpec& plant) { return plant.name == spec.plants; });
  const auto number = static_cast<std::size_t>(planting - scene.plants.begin());
  if (planting == scene.plants.end() || number >= growth.stands.size())
    throw sim::InputError(
        fmt::format("there are no plants {}; expected one of the scene's", inQuotes(spec.plants)));
  sim::HeightRaster raster = rasterOf(spec, frame);
  sim::PlanLines lines = linesOf(growth, growth.stands[number], frame, spec.iteration);
  const std::uint64_t stream = sim::streamOf(scene.seed, spec.name);
  requireMemory(sim::meanderBytes(lines, spec.meander, raster.spacing_m));
  lines = sim::meandering(lines, spec.meander, raster.spacing_m, stream);
  requireLines(spec, lines, raster);
  requireMemory(sim::reliefBytes(raster, lines, spec.law.noise));
  MadeHeights made;
  made.name = spec.name;
  made.relief = sim::makeRelief(std::move(raster), lines, spec.law, stream);
  addMeshes(made, spec);
  return made;
}

}  // namespace

bool showsHeights(const ImageSpec& image) {
  return image.kind == ImageKind::vines &&
         std::find(image.show.begin(), image.show.end(), "heights") != image.show.end();
}

std::vector<MadeHeights> makeHeights(const Scene& scene, const sim::Growth& growth, const sim::Frame& frame,
                                     const sim::Sky* sky) {
  std::vector<MadeHeights> all;
  for (const HeightsSpec& spec : scene.heights) {
    all.push_back(inScene(scene, spec.place, [&] { return makeOne(scene, spec, growth, frame); }));
    const bool drawn = std::any_of(scene.images.begin(), scene.images.end(), [&](const ImageSpec& image) {
      return showsHeights(image) &&
             (image.heights.empty() ? &spec == scene.heights.data() : image.heights == spec.name);
    });
    if (sky != nullptr && drawn) inScene(scene, spec.place, [&] { lightUp(all.back(), *sky); });
  }
  return all;
}

std::vector<std::string> heightFileNames(const Scene& scene) {
  std::vector<std::string> names;
  for (const HeightsSpec& spec : scene.heights) {
    names.push_back(spec.name + ".exr");
    names.push_back(spec.name + ".glb");
  }
  return names;
}

std::vector<OutputFile> heightFiles(const std::vector<MadeHeights>& made, const sim::Provenance& made_by) {
  std::vector<OutputFile> files;
  for (const MadeHeights& one : made) {
    files.push_back(fileOf(one.name + ".exr", [&one, &made_by] {
      const sim::HeightRaster& raster = one.relief.raster;
      render::Image image(raster.wide, raster.deep, 1);
      image.pixels = raster.height_m;
      render::Metadata metadata = {{"Title", one.name}};
      for (auto& entry : render::textsOf(made_by)) metadata.push_back(std::move(entry));
      metadata.emplace_back("espalier:unit", "metres");
      metadata.emplace_back("espalier:spacing_m", fmt::format("{}", raster.spacing_m));
      metadata.emplace_back("espalier:first_x_m", fmt::format("{}", raster.low_m.x));
      metadata.emplace_back("espalier:first_z_m", fmt::format("{}", raster.low_m.y));
      return render::encodeExr(image, {"height"}, metadata);
    }));
    files.push_back({one.name + ".glb", [&one, &made_by](std::iostream& out) {
                       std::vector<const sim::Mesh*> meshes;
                       for (const sim::Mesh& mesh : one.meshes) meshes.push_back(&mesh);
                       render::writeGlb(
                           out, meshes, [](const auto&) {}, made_by);
                     }});
  }
  return files;
}

}  // namespace espalier::scenes
