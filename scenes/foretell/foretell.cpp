#include "scenes/foretell/foretell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "render/voxels/visibility.h"
#include "scenes/foretell/costs.h"
#include "scenes/foretell/growth_ahead.h"
#include "scenes/foretell/speed.h"
#include "sim/base/memory.h"
#include "sim/base/parallel.h"
#include "sim/world/band.h"

namespace espalier::scenes {
namespace {

constexpr double kBytesASegment = 700.0;  // while it grows, with its elements and voxels

double since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

LitWorld litWorld(const Site& site) {
  LitWorld lit;
  const sim::Vec3 size(site.world.frame().size);
  lit.voxels = size.x * size.y * size.z;
  lit.places = static_cast<double>(sim::freeBand(site.world, site.world.occupied(), 1).count());
  lit.sky_directions = static_cast<double>(site.sky.directions.size());
  if (site.random_sky) lit.random_rays = site.random_sky->rays;
  lit.sun_directions = static_cast<double>(site.sun.directions.size());
  return lit;
}

const render::Camera* cameraNamed(const std::vector<NamedCamera>& cameras, const std::string& name) {
  for (const NamedCamera& camera : cameras) {
    if (name.empty() || camera.name == name) return &camera.camera;
  }
  return nullptr;
}

/// Triangles that plants are modelled with: limbs stitched to each other, and polygons on stalks.
double trianglesOf(const Grown& grown, const std::vector<sim::Planting>& plantings) {
  constexpr double kASegment = 33.0, kAStalk = 3.0;
  std::size_t most = 0;
  for (const sim::Planting& planting : plantings) {
    for (const sim::ElementShape& shape : planting.process->seedling().shapes) {
      std::size_t triangles = 0;
      for (const auto& polygon : shape.polygons)
        triangles += polygon.size() - std::min<std::size_t>(2, polygon.size());
      most = std::max(most, triangles);
    }
  }
  return kASegment * grown.segments + (kAStalk + static_cast<double>(most)) * grown.elements;
}

double trianglesOf(const std::vector<sim::TiledMesh>& meshes) {
  double triangles = 0.0;
  for (const sim::TiledMesh& tiled : meshes) triangles += static_cast<double>(tiled.mesh.triangles.size());
  return triangles;
}

/// What the cameras of panels see, by a look at few pixels; `looks` false: by guess.
std::vector<Seen> seenBy(const PicturesWanted& wanted, const sim::World& world, bool looks) {
  constexpr int kCoarser = 4;
  constexpr double kGuess = 0.5;     // pixels that see several faces, as a share
  constexpr double kOfCoarse = 0.4;  // of what it is where pixels are so much wider
  std::map<std::string, Seen> by_camera;
  for (const ImageSpec& image : wanted.images) {
    if (!isPanel(image.kind)) continue;
    Seen& seen = by_camera[image.camera];
    ++seen.panels;
    seen.shadows =
        seen.shadows || image.kind == ImageKind::shadow_matte || image.kind == ImageKind::first_pass;
  }
  const double pixels = static_cast<double>(wanted.width_px) * wanted.height_px;
  std::optional<sim::Bricks> bricks;
  std::vector<Seen> result;
  for (auto& [name, seen] : by_camera) {
    double more = kGuess;
    const int width = wanted.width_px / kCoarser, height = wanted.height_px / kCoarser;
    const render::Camera* const camera = cameraNamed(wanted.cameras, name);
    const auto in_the_open = [&] {
      return !world.occupied().at(sim::voxelAt(sim::voxelFromWorld(world.frame(), camera->eye_m)));
    };
    if (looks && camera && width > 0 && height > 0 && in_the_open()) {
      if (!bricks) bricks.emplace(world.occupied());
      const auto coarse = render::see(world.frame(), world.occupied(), *bricks, *camera, width, height);
      more = kOfCoarse *
             (static_cast<double>(coarse.fragments.size()) / (static_cast<double>(width) * height) - 1.0);
    }
    seen.fragments = pixels * (1.0 + more);
    result.push_back(seen);
  }
  return result;
}

/// To two digits, and a whole number.
double rounded(double value) {
  const double digit = std::pow(10.0, std::max(0.0, std::floor(std::log10(std::max(value, 1.0))) - 1.0));
  return std::round(value / digit) * digit;
}

/// Adds what is still to come.
Foretold foretold(const Site& site, double seconds, const std::vector<StageCost>& costs,
                  double bytes_before) {
  constexpr double kStart_s = 0.1;  // until the program and its libraries are loaded
  Foretold told{site.world.frame(), kStart_s + seconds, bytes_before, {}};
  const Speed speed = measuredSpeed();
  double held = bytes_before;
  for (const StageCost& cost : costs) {
    const double stage_s = secondsOf(cost.work, speed);
    told.seconds += stage_s;
    told.stages_s.emplace_back(cost.stage, stage_s);
    told.bytes = std::max(told.bytes, held + cost.bytes_while);
    held += cost.bytes_kept;
  }
  return told;
}

/// Of light that bounces, where pictures have it.
void addBouncing(const PicturesWanted& pictures, const LitWorld& lit, std::vector<StageCost>& costs) {
  const LitKinds kinds = litKinds(pictures.images);
  const int count = int{kinds.first_pass} + int{kinds.vines || pictures.film_frames > 0};
  if (pictures.interreflection && count > 0)
    costs.push_back(bouncingCost(lit, *pictures.interreflection, count));
}

std::vector<StageCost> costsAfterGrowth(const PicturesWanted& pictures, double triangles, LitWorld lit,
                                        const std::vector<Seen>& seen) {
  lit.dense = std::any_of(pictures.images.begin(), pictures.images.end(),
                          [](const ImageSpec& image) { return image.kind == ImageKind::vines; });
  std::vector<StageCost> costs{lightingCost(lit)};
  addBouncing(pictures, lit, costs);
  if (!pictures.images.empty()) {
    costs.push_back(modellingCost(triangles));
    costs.push_back(drawingCost(pictures, seen, triangles));
  }
  if (pictures.film_frames > 0) costs.push_back(filmingCost(pictures, lit, triangles));
  costs.push_back(writingCost(pictures, lit, triangles));
  return costs;
}

}  // namespace

std::string toText(const Foretold& foretold) {
  const sim::Voxel size = foretold.frame.size;
  const std::string time = foretold.seconds < 1.0 ? "less than a second"
                                                  : fmt::format("about {:.0f} s", rounded(foretold.seconds));
  const std::string memory = foretold.bytes < 1e9
                                 ? fmt::format("{:.0f} MB", rounded(foretold.bytes / 1e6))
                                 : fmt::format("{:.1f} GB", rounded(foretold.bytes / 1e8) / 10.0);
  return fmt::format("{} x {} x {} voxels of {:.4g} m; {} and {} of memory", size.x, size.y, size.z,
                     foretold.frame.voxel_m, time, memory);
}

namespace {

/// Of a job in which so much will have grown by then, in a world that is lit thereafter.
Foretold foretellGrown(const Site& site, const std::vector<sim::Planting>& plantings, const Grown& grown,
                       const LitWorld& lit, const PicturesWanted& pictures, double seconds, double bytes) {
  const double triangles = trianglesOf(grown, plantings) + trianglesOf(site.meshes);
  const std::vector<Seen> seen = seenBy(pictures, site.world, true);
  return foretold(site, seconds, costsAfterGrowth(pictures, triangles, lit, seen), bytes);
}

}  // namespace

Grown grownIn(std::span<const sim::Plant> plants) {
  Grown grown;
  for (const sim::Plant& plant : plants) {
    grown.segments += static_cast<double>(plant.skeleton.parent.size()) - 1.0;
    grown.elements += static_cast<double>(plant.elements.size());
  }
  return grown;
}

GrowthForeteller::GrowthForeteller(const Site& site, const std::vector<sim::Planting>& plantings,
                                   PicturesWanted pictures, int iterations, const sim::Growth& growth,
                                   Clock::time_point began)
    : site_(site),
      plantings_(plantings),
      pictures_(std::move(pictures)),
      near_surfaces_(bricksNearSurfaces(site.world)),
      lit_before_(litWorld(site)),
      iterations_(iterations),
      job_began_(began),
      segments_before_(grownIn(growth.plants).segments) {
  for (const StageCost& cost :
       costsAfterGrowth(pictures_, 0.0, lit_before_, seenBy(pictures_, site.world, false)))
    later_s_ += cost.work.alone_s + cost.work.shared_s / sim::threadCount();
}

std::optional<Foretold> GrowthForeteller::after(const sim::Growth& growth, bool over) {
  constexpr double kShare = 0.2, kAgain = 1.2;
  constexpr double kLaterDearer = 1.35;  // a segment, where it has become narrow
  const Grown now = grownIn(growth.plants);
  const double spent_s = since(growth_began_);
  const int more = over ? 0 : iterations_ - growth.iterations;
  if (more > 0 && spent_s < std::max(ask_again_s_, kShare * later_s_)) return std::nullopt;
  ask_again_s_ = kAgain * spent_s;
  Grown in_all = now;
  double ahead_s = 0.0;
  const double new_segments = now.segments - segments_before_;
  if (more > 0 && new_segments > 0.0) {
    in_all.segments = segmentsAhead(growth.plants, near_surfaces_, growth.iterations, more);
    in_all.elements *= in_all.segments / now.segments;
    ahead_s = kLaterDearer * spent_s * (in_all.segments - now.segments) / new_segments;
    if (spent_s < kShare * (ahead_s + later_s_)) return std::nullopt;
  }
  LitWorld lit = litWorld(site_);
  if (new_segments > 0.0)
    lit.places += (lit.places - lit_before_.places) / new_segments * (in_all.segments - now.segments);
  Foretold told = foretellGrown(site_, plantings_, in_all, lit, pictures_, since(job_began_) + ahead_s,
                                sim::memoryInUse() + kBytesASegment * (in_all.segments - now.segments));
  told.stages_s.insert(told.stages_s.begin(), {"growing", spent_s + ahead_s});
  return told;
}

Foretold foretellPictures(const Site& site, const std::vector<sim::Planting>& plantings, const Grown& grown,
                          const PicturesWanted& pictures, Clock::time_point began) {
  return foretellGrown(site, plantings, grown, litWorld(site), pictures, since(began), sim::memoryInUse());
}

Foretold foretellExposure(const Site& site, const sim::VoxelSet* space, const PicturesWanted& pictures,
                          Clock::time_point began) {
  LitWorld lit = litWorld(site);
  if (space) lit.space = static_cast<double>(space->count());
  std::vector<StageCost> costs{lightingCost(lit)};
  addBouncing(pictures, lit, costs);
  if (!site.random_sky) costs.push_back(certifyingCost(lit));
  costs.push_back(countingCost(lit));
  if (!pictures.images.empty())
    costs.push_back(drawingCost(pictures, seenBy(pictures, site.world, true), 0.0));
  costs.push_back(writingCost(pictures, lit, 0.0));
  return foretold(site, since(began), costs, sim::memoryInUse());
}

}  // namespace espalier::scenes
