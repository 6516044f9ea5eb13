#include "scenes/show/bounced_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/finish/finished_picture.h"
#include "render/voxels/panels.h"
#include "scenes/lights.h"
#include "sim/base/counted.h"
#include "sim/base/faces.h"
#include "sim/base/memory.h"
#include "sim/base/parallel.h"

namespace espalier::scenes {
namespace {

sim::BounceSources sourcesOf(const sim::World& world, const sim::Lighting& light, const EmittedLight& emitted,
                             const BouncedLight::Outdoors& outdoors) {
  const std::size_t surfaces = light.surfaces.size(), count = surfaces + light.faces.size();
  sim::BounceSources sources{outdoors.sky, outdoors.below, {}, {}, {}};
  sources.sun.resize(count);
  sources.albedo.resize(count);
  if (emitted.any()) sources.emitted.resize(count);
  sim::parallelFor(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const bool surface = i < surfaces;
      const std::uint64_t face = surface ? 0 : light.faces[i - surfaces];
      const sim::Voxel v = surface ? light.surfaces[i].voxel : light.voxelOf(face);
      const sim::Vec3f normal =
          surface ? light.surfaces[i].surface.normal : sim::Vec3f(sim::kFaceNormals[face % sim::kFaces]);
      const float slant = std::max(0.0f, glm::dot(normal, sim::Vec3f(outdoors.to_sun)));
      sources.sun[i] = light.sun_now.values[i] * slant * outdoors.sun;
      const sim::Colour own = surface ? light.surfaces[i].surface.colour : world.surfaceAt(v)->colour;
      sources.albedo[i] = glm::clamp(own, 0.0f, 1.0f);
      if (emitted.any()) sources.emitted[i] = emitted.at(v);
    }
  });
  return sources;
}

sim::BounceSettings bounceSettings(const Scene& scene) {
  sim::BounceSettings settings;
  const InterreflectionSpec& spec = *scene.interreflection;
  settings.directions = spec.directions;
  settings.passes = spec.passes;
  settings.tolerance = spec.tolerance;
  settings.lambert = spec.weighting == BounceWeighting::lambert;
  settings.overcast = scene.sky.weighting == sim::Weighting::cie_overcast;
  // What later passes need again may take half of what is free.
  const double free = std::max(0.0, sim::memoryBudget() - sim::memoryInUse());
  settings.most_bytes = std::min(settings.most_bytes, static_cast<std::size_t>(0.5 * free));
  return settings;
}

std::string describe(const sim::BounceSettings& settings, const BouncedLight& light) {
  return fmt::format("{} of at most {}, {} directions over the sphere, {}; last change {:.2g}",
                     sim::counted(static_cast<std::uint64_t>(light.passes()), "pass", "passes"),
                     settings.passes, 2 * settings.directions,
                     settings.lambert ? "by Lambert's cosine" : "all alike", light.change());
}

}  // namespace

BouncedLight::BouncedLight(const sim::World& world, const sim::Lighting& light, const EmittedLight& emitted,
                           sim::Interreflection& interreflection, const Outdoors& outdoors)
    : world_(world),
      light_(light),
      below_(outdoors.below),
      bounced_(interreflection.of(sourcesOf(world, light, emitted, outdoors))) {
  for (std::size_t c = 0; c < ambient_.size(); ++c) {
    const int channel = static_cast<int>(c);
    ambient_[c].values.resize(bounced_.light.size());
    for (std::size_t i = 0; i < bounced_.light.size(); ++i)
      ambient_[c].values[i] = bounced_.sky[i] * outdoors.sky[channel] + broughtTo(i)[channel];
    for (std::size_t face = 0; face < ambient_[c].beyond.size(); ++face)
      ambient_[c].beyond[face] = light.sky.beyond[face] * outdoors.sky[channel];
  }
}

void BouncedLight::addSurface(sim::Voxel voxel, sim::Vec3f normal, float weight, Sum& sum) const {
  if (!light_.where->has(voxel)) return;
  const std::size_t number = light_.where->number(voxel);
  const float alike = glm::dot(light_.surfaces[number].surface.normal, normal);
  constexpr float kLeast = 0.2f;  // what looks another way is lit otherwise
  if (alike > kLeast) sum.add(broughtTo(number), weight * (alike - kLeast));
}

void BouncedLight::addFaces(sim::Voxel voxel, sim::Vec3f normal, float weight, Sum& sum) const {
  if (!light_.gaps->has(voxel) && !light_.where->has(voxel)) return;
  const std::uint64_t first = light_.faceKey(voxel, 0);
  auto at = std::lower_bound(light_.faces.begin(), light_.faces.end(), first);
  for (; at != light_.faces.end() && *at < first + sim::kFaces; ++at) {
    const float alike = glm::dot(sim::Vec3f(sim::kFaceNormals[*at - first]), normal);
    const std::size_t number = light_.surfaces.size() + static_cast<std::size_t>(at - light_.faces.begin());
    if (alike > 0.0f) sum.add(broughtTo(number), weight * alike);
  }
}

sim::Colour BouncedLight::at(sim::Vec3 place_vx, sim::Vec3f normal) const {
  const sim::Voxel size = world_.frame().size;
  const sim::Vec3 p = glm::clamp(place_vx, sim::Vec3(0.0), sim::Vec3(size) - 1.0);
  const sim::Voxel low(glm::floor(p));
  const sim::Vec3f part(p - sim::Vec3(low));
  const auto around = [&](const auto& add) {
    Sum sum;
    for (int corner = 0; corner < 8; ++corner) {
      const sim::Voxel off(corner & 1, (corner >> 1) & 1, corner >> 2);
      const sim::Vec3f shares = glm::mix(1.0f - part, part, sim::Vec3f(off));
      const sim::Voxel v = low + off;
      if (sim::contains(size, v)) add(v, shares.x * shares.y * shares.z + 1e-4f, sum);
    }
    return sum;
  };
  Sum sum = around([&](sim::Voxel v, float weight, Sum& to) { addSurface(v, normal, weight, to); });
  constexpr float kEnough = 1e-3f;
  if (sum.weight < kEnough)
    sum = around([&](sim::Voxel v, float weight, Sum& to) { addFaces(v, normal, weight, to); });
  if (sum.weight < kEnough) {  // the far side of a thin thing: whatever lies around
    const sim::Voxel nearest(glm::round(p));
    for (int i = 0; i < 27; ++i) {
      const sim::Voxel v = nearest + sim::Voxel(i % 3, i / 9, i / 3 % 3) - 1;
      if (!sim::contains(size, v)) continue;
      addSurface(v, normal, 1.0f, sum);
      addFaces(v, normal, 1.0f, sum);
    }
  }
  return sum.weight > 0.0f ? sum.light / sum.weight : sim::Colour(0.0f);
}

std::function<sim::Colour(sim::Vec3, sim::Vec3f)> bouncedIn(const PictureLight& lit,
                                                            const sim::Frame& frame) {
  if (!lit.vines) return {};
  return [bounced = lit.vines, frame](sim::Vec3 p_m, sim::Vec3f normal) {
    return bounced->at(sim::voxelFromWorld(frame, p_m), normal);
  };
}

LitKinds litKinds(const std::vector<ImageSpec>& images) {
  LitKinds kinds;
  for (const ImageSpec& image : images) {
    kinds.first_pass =
        kinds.first_pass || image.kind == ImageKind::first_pass || image.kind == ImageKind::volume;
    kinds.vines = kinds.vines || image.kind == ImageKind::vines;
  }
  return kinds;
}

namespace {

BouncedLight::Outdoors outdoorsOf(const Scene& scene, const std::vector<sim::TiledMesh>& meshes,
                                  const sim::World& world, sim::Vec3 to_sun) {
  std::vector<const sim::Mesh*> scene_meshes;
  for (const sim::TiledMesh& tiled : meshes) {
    if (!tiled.guide) scene_meshes.push_back(&tiled.mesh);
  }
  const render::OutdoorLight outdoors =
      render::outdoorLight(scene_meshes, world.frame().voxel_m, to_sun, daylightShare(scene));
  return {outdoors.sky, outdoors.ground, outdoors.sun, to_sun};
}

}  // namespace

GrowingBounce::GrowingBounce(const Scene& scene, const std::vector<sim::TiledMesh>& meshes,
                             const sim::World& world, const std::vector<sim::Plant>& plants,
                             const sim::Lighting& light, sim::Vec3 to_sun)
    : world_(world),
      light_(light),
      emitted_(meshes, world, plants),
      outdoors_(outdoorsOf(scene, meshes, world, to_sun)),
      settings_(bounceSettings(scene)) {}

std::shared_ptr<const BouncedLight> GrowingBounce::when(const sim::BitVolume& stood) {
  if (!interreflection_) interreflection_.emplace(world_, light_, settings_);
  emitted_.darkenBut(stood);
  return std::make_shared<const BouncedLight>(world_, light_, emitted_, *interreflection_, outdoors_);
}

PictureLight pictureLight(const Scene& scene, const std::vector<sim::TiledMesh>& meshes,
                          const sim::World& world, const std::vector<sim::Plant>& plants,
                          sim::Lighting& light, const LitKinds& kinds, sim::Vec3 to_sun) {
  PictureLight lit;
  if (!kinds.any()) return lit;
  auto emitted = std::make_shared<EmittedLight>(meshes, world, plants);
  if (scene.interreflection) {
    const sim::BounceSettings settings = bounceSettings(scene);
    sim::Interreflection interreflection(world, light, settings);
    const auto bounced = [&](const BouncedLight::Outdoors& outdoors) {
      return std::make_shared<const BouncedLight>(world, light, *emitted, interreflection, outdoors);
    };
    if (kinds.first_pass) {
      const render::FirstPassLight outdoors = render::firstPassLight();
      lit.first_pass = bounced({outdoors.sky, sim::Colour(0.0f), outdoors.sun, to_sun});
    }
    if (kinds.vines) lit.vines = bounced(outdoorsOf(scene, meshes, world, to_sun));
    light.about.interreflection = describe(settings, lit.first_pass ? *lit.first_pass : *lit.vines);
  }
  if (emitted->any()) lit.emitted = std::move(emitted);
  return lit;
}

}  // namespace espalier::scenes
