#include "scenes/prepare/plantings.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "rules/growth/apices.h"
#include "rules/growth/given_skeleton.h"
#include "rules/growth/make_process.h"
#include "rules/growth/rule_book.h"
#include "rules/growth/scene_lines.h"
#include "rules/growth/scene_surfaces.h"
#include "rules/growth/senses.h"
#include "rules/growth/shared_guide.h"
#include "scenes/lights.h"
#include "scenes/prepare/in_scene.h"
#include "scenes/prepare/unknown_regions.h"
#include "scenes/problem.h"
#include "sim/base/counted.h"
#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/grow/faults.h"
#include "sim/sense/peaks.h"

namespace espalier::scenes {
namespace {

/// The open voxels right above a region, in (y, z, x) order.
std::vector<sim::Voxel> placesAbove(const sim::World& world, const std::string& region) {
  const sim::BitVolume& occupied = world.occupied();
  std::vector<sim::Voxel> places;
  for (int y = 0; y + 1 < occupied.size().y; ++y) {
    for (int z = 0; z < occupied.size().z; ++z) {
      const std::uint64_t *const row = occupied.row(y, z), *const above = occupied.row(y + 1, z);
      for (int w = 0; w < occupied.rowWords() - 1; ++w) {
        for (std::uint64_t left = row[w] & ~above[w]; left != 0; left &= left - 1) {
          const sim::Voxel v(w * sim::BitVolume::kWordBits + std::countr_zero(left), y, z);
          if (world.part(world.partAt(v)).region == region) places.push_back(v + sim::Voxel(0, 1, 0));
        }
      }
    }
  }
  return places;
}

/// Seeds in the open voxels right above a region, drawn without putting two in one place.
std::vector<sim::Vec3> scatter(const sim::World& world, const Scatter& spec, std::uint64_t stream) {
  std::vector<sim::Voxel> open = placesAbove(world, spec.region);
  if (open.size() < static_cast<std::size_t>(spec.count)) {
    throw sim::InputError(fmt::format("scatter: region '{}' has {} up; expected at least {}", spec.region,
                                      sim::counted(open.size(), "place that looks", "places that look"),
                                      spec.count));
  }
  std::vector<sim::Vec3> seeds;
  for (int i = 0; i < spec.count; ++i) {  // Fisher and Yates, as far as needed
    sim::Draws draws({stream, static_cast<std::uint32_t>(i)}, sim::Purpose::scatter);
    const int pick = draws.whole(i, static_cast<int>(open.size()) - 1);
    std::swap(open[static_cast<std::size_t>(i)], open[static_cast<std::size_t>(pick)]);
    seeds.emplace_back(open[static_cast<std::size_t>(i)]);
  }
  return seeds;
}

/// Those that were given, in their order, then those of a table, then those that were strewn.
std::vector<sim::Seed> seedsOf(const PlantSpec& spec, const std::vector<sim::Vec3>& listed_m,
                               const Site& site, const Scene& scene) {
  const sim::Frame& frame = site.world.frame();
  std::vector<sim::Vec3> unnamed_vx;
  for (const SeedSpec& s : spec.seeds) {
    if (s.key.empty()) unnamed_vx.push_back(sim::voxelFromWorld(frame, s.at_m));
  }
  for (const sim::Vec3& at_m : listed_m) unnamed_vx.push_back(sim::voxelFromWorld(frame, at_m));
  if (spec.scatter) {
    std::vector<sim::Vec3> strewn_vx;
    inScene(scene, spec.scatter->region_place,
            [&] { strewn_vx = scatter(site.world, *spec.scatter, sim::streamOf(scene.seed, spec.name)); });
    unnamed_vx.insert(unnamed_vx.end(), strewn_vx.begin(), strewn_vx.end());
  }
  std::vector<sim::Seed> seeds = sim::seedsAt(frame, unnamed_vx);
  for (std::size_t i = 0; i < spec.seeds.size(); ++i) {
    const SeedSpec& s = spec.seeds[i];
    if (s.key.empty()) continue;
    seeds.insert(seeds.begin() + static_cast<std::ptrdiff_t>(i),
                 {sim::voxelFromWorld(frame, s.at_m), sim::keyOfName(s.key)});
  }
  return seeds;
}

/// Its rules, which name the attractors of its own crown if they state one.
std::shared_ptr<const rules::RuleSet> rulesOf(const PlantSpec& spec) {
  if (!spec.rules->colonization.crown) return spec.rules;
  rules::RuleSet own = *spec.rules;
  own.colonization.attractors = attractorsFor(spec);
  return std::make_shared<const rules::RuleSet>(std::move(own));
}

/// A tree of a skeleton file in the world's voxels. Throws where it does not stand in the world.
rules::GivenTree givenTree(const FileTree& tree, const SkeletonSpec& spec, const sim::Frame& frame) {
  rules::GivenTree given;
  given.parent.assign(tree.parent.begin(), tree.parent.end());
  for (std::size_t n = 0; n < tree.position.size(); ++n) {
    const sim::Vec3 at_m = tree.position[n];
    given.position_vx.push_back(sim::voxelFromWorld(frame, at_m));
    if (rules::standsIn(frame.size, given.position_vx.back())) continue;
    const sim::Vec3 low = sim::worldFromVoxel(frame, sim::Vec3(-0.5)),
                    high = sim::worldFromVoxel(frame, sim::Vec3(frame.size) - 0.5);
    throw sim::InputError(fmt::format(
        "{}: node {}{} stands at [{:.4g}, {:.4g}, {:.4g}] m, outside of the world, which reaches from "
        "[{:.4g}, {:.4g}, "
        "{:.4g}] to [{:.4g}, {:.4g}, {:.4g}]; expected another scale, rotate or translate, or a larger world "
        "(bounds, "
        "margin)",
        spec.told, tree.number[n], tree.name.empty() ? "" : fmt::format(" of {}", inQuotes(tree.name)),
        at_m.x, at_m.y, at_m.z, low.x, low.y, low.z, high.x, high.y, high.z));
  }
  for (const float radius_m : tree.radius)
    given.radius_vx.push_back(static_cast<float>(radius_m / frame.voxel_m));
  return given;
}

/// Each tree from its root.
sim::Planting given(const PlantSpec& spec, const std::vector<FileTree>& trees, const Scene& scene,
                    const sim::Frame& frame) {
  std::vector<rules::GivenTree> all;
  std::vector<sim::Vec3> roots_vx;
  for (const FileTree& tree : trees) {
    inScene(scene, spec.skeleton->place, [&] { all.push_back(givenTree(tree, *spec.skeleton, frame)); });
    roots_vx.push_back(all.back().position_vx.front());
  }
  return {spec.name,
          rules::makeGivenSkeleton(spec.rules, frame, std::move(all),
                                   scene.skeleton_iterations.value_or(scene.iterations)),
          sim::seedsAt(frame, roots_vx), true};
}

sim::Planting plant(const PlantSpec& spec, const std::vector<sim::Vec3>& listed_m, const Site& site,
                    const Scene& scene, const std::shared_ptr<const sim::SceneSurface>& surface) {
  return {spec.name, rules::makeProcess(rulesOf(spec), site.world.frame(), lays(spec) ? surface : nullptr),
          seedsOf(spec, listed_m, site, scene)};
}

/// Where a scene's file has a seed of a planting: those that were given come first, the others hang on the
/// table or the region.
const Place& placeOfSeed(const PlantSpec& spec, std::size_t seed) {
  if (spec.skeleton) return spec.skeleton->place;
  if (seed < spec.seeds.size()) return spec.seeds[seed].place;
  return spec.table.file.empty() ? spec.scatter->region_place : spec.table.place;
}

/// `of`: which of the scene's plants each planting is of. Of many seeds of one place, such as a table's, the
/// first is told of.
void addFaults(const std::vector<sim::PlantingFault>& faults, const Scene& scene,
               const std::vector<std::size_t>& of, Gathering& wrong) {
  std::vector<std::pair<Problem, std::size_t>> told;  // and how many more there are
  std::map<std::tuple<std::size_t, int, int>, std::size_t> at;
  for (const sim::PlantingFault& fault : faults) {
    const PlantSpec& spec = scene.plants.at(of.at(fault.planting));
    const Place& place = fault.seed ? placeOfSeed(spec, *fault.seed) : spec.rules_place;
    const auto [known, is_new] = at.try_emplace({fault.planting, place.line, place.column}, told.size());
    if (is_new) {
      told.emplace_back(problemAt(place, scene.file, fault.text), 0);
    } else {
      ++told[known->second].second;
    }
  }
  for (auto& [problem, more] : told) {
    if (more > 0) problem.text += fmt::format("; {} more of its seeds are as wrong", more);
    wrong.add(std::move(problem));
  }
}

/// The apices of all of a scene's regions.
std::vector<sim::Peak> apicesOf(const sim::World& world) {
  constexpr int kProminence_vx = 3;  // stairs of what is not level are no apices
  std::vector<sim::PartId> parts;
  for (std::size_t i = 0; i < world.parts().size(); ++i) {
    if (world.parts()[i].kind == sim::PartKind::scene) parts.push_back(static_cast<sim::PartId>(i + 1));
  }
  return sim::peaksOf(world, parts, kProminence_vx);
}

/// Complains where a rule set names a region for its apices that has none.
void requireApices(const PlantSpec& spec, const Scene& scene, const sim::World& world, Gathering& wrong) {
  if (!rules::asksForApices(*spec.rules)) return;
  std::set<std::string> high;
  for (const sim::Peak& apex : apicesOf(world)) high.insert(world.part(apex.part).region);
  rules::forEachSet(*spec.rules, [&](const rules::RuleSet& set, const std::string& path) {
    if (set.bias.apex_of.empty() || high.contains(set.bias.apex_of)) return;
    wrong.add(problemAt(spec.rules_place, scene.file,
                        fmt::format("{}bias.apex.of: the scene has no region {} with an apex; expected {}",
                                    path.empty() ? "" : path + ".", inQuotes(set.bias.apex_of),
                                    high.empty() ? "a region that is not level"
                                                 : "one of " + listed({high.begin(), high.end()}))));
  });
}

/// All of a scene's lines, guides too.
std::vector<rules::LineEnds> linesOf(const Site& site) {
  std::vector<rules::LineEnds> lines_vx;
  const sim::Frame& frame = site.world.frame();
  for (const sim::TiledMesh& mesh : site.meshes) {
    for (const sim::Line& line : mesh.lines)
      lines_vx.emplace_back(sim::voxelFromWorld(frame, line.from_m), sim::voxelFromWorld(frame, line.to_m));
  }
  return lines_vx;
}

/// Those of all of a scene's meshes, guides too.
std::vector<rules::TriangleCorners> surfacesOf(const Site& site) {
  std::vector<rules::TriangleCorners> triangles_vx;
  const sim::Frame& frame = site.world.frame();
  for (const sim::TiledMesh& tiled : site.meshes) {
    if (!tiled.lines.empty()) continue;
    const sim::Mesh& mesh = tiled.mesh;
    for (const auto& [a, b, c] : mesh.triangles) {
      triangles_vx.push_back({sim::voxelFromWorld(frame, mesh.vertices_m[a]),
                              sim::voxelFromWorld(frame, mesh.vertices_m[b]),
                              sim::voxelFromWorld(frame, mesh.vertices_m[c])});
    }
  }
  return triangles_vx;
}

/// Complains where a rule set senses lines or surfaces of a scene that has none.
void requireSensed(const PlantSpec& spec, const Scene& scene, const Site& site, Gathering& wrong) {
  const auto require = [&](bool asks, bool has, const char* what, const char* expected) {
    if (!asks || has) return;
    wrong.add(
        problemAt(spec.rules_place, scene.file,
                  fmt::format("senses are of: {}, and the scene has none; expected {}", what, expected)));
  };
  require(rules::hasSenseOf(*spec.rules, rules::kOfLines), !linesOf(site).empty(), rules::kOfLines,
          "a mesh with lines");
  require(rules::hasSenseOf(*spec.rules, rules::kOfSurfaces), !surfacesOf(site).empty(), rules::kOfSurfaces,
          "a mesh with faces");
}

}  // namespace

std::vector<sim::Planting> makePlantings(const Scene& scene, const Site& site) {
  std::vector<sim::Planting> plantings;
  std::vector<std::size_t> of;
  Gathering wrong(scene.file);
  const auto unknown = unknownToScatterOver(scene, site.world);
  std::shared_ptr<const sim::SceneSurface> surface;
  if (std::any_of(scene.plants.begin(), scene.plants.end(), lays))
    surface = sim::surfaceOf(site.world.frame(), site.meshes);
  for (std::size_t i = 0; i < scene.plants.size(); ++i) {
    const PlantSpec& spec = scene.plants[i];
    if (unknown[i]) {
      wrong.add(*unknown[i]);
      continue;
    }
    requireApices(spec, scene, site.world, wrong);
    requireSensed(spec, scene, site, wrong);
    wrong.part(spec.rules_place, [&] {
      plantings.push_back(
          spec.skeleton ? given(spec, site.skeletons.at(i), scene, site.world.frame())
                        : plant(spec, site.listed_m.at(scene.attractors.size() + i), site, scene, surface));
      of.push_back(i);
    });
  }
  addFaults(sim::seedFaults(site.world, plantings), scene, of, wrong);
  wrong.end();
  return plantings;
}

std::unique_ptr<sim::Growing> beginGrowth(const Scene& scene, Site& site,
                                          const std::vector<sim::Planting>& plantings,
                                          const sim::GrowthSettings& settings) {
  return inScene(scene, [&] {
    try {
      return std::make_unique<sim::Growing>(site.world, plantings, settings);
    } catch (const sim::PlantingFaults& error) {
      Gathering wrong(scene.file);
      std::vector<std::size_t> of(plantings.size());
      std::iota(of.begin(), of.end(), std::size_t{0});
      addFaults(error.faults(), scene, of, wrong);
      wrong.end();
      throw;
    }
  });
}

sim::GrowthSettings growthSettings(const Scene& scene, const Site& site,
                                   const std::vector<NamedPoints>& attractors) {
  sim::GrowthSettings settings;
  settings.iterations = scene.iterations;
  settings.seed = scene.seed;
  settings.light = {sim::receivedBy(site.sky), site.sun.directions, site.random_sky, site.sky.weighting};
  settings.sky_table = [background = backgroundOf(scene.sky, site.sky_picture, site.sun.directions)] {
    return skyTableOf(background);
  };
  settings.commons = commonsOf(attractors);
  if (std::any_of(scene.plants.begin(), scene.plants.end(),
                  [](const PlantSpec& plant) { return rules::asksForApices(*plant.rules); }))
    settings.commons[rules::kApices] = rules::columnsOf(apicesOf(site.world));
  if (std::any_of(scene.plants.begin(), scene.plants.end(),
                  [](const PlantSpec& plant) { return rules::hasSenseOf(*plant.rules, rules::kOfLines); }))
    settings.commons[rules::kSceneLines] = rules::columnsOf(linesOf(site));
  if (std::any_of(scene.plants.begin(), scene.plants.end(),
                  [](const PlantSpec& plant) { return rules::hasSenseOf(*plant.rules, rules::kOfSurfaces); }))
    settings.commons[rules::kSceneSurfaces] = rules::columnsOf(surfacesOf(site));
  for (std::size_t i = 0; i < scene.fields.size(); ++i) {
    const rules::Guide guide = guideOf(scene.fields[i], site.fields.at(i), site.world.frame());
    settings.commons[rules::fieldNamed(scene.fields[i].name)] = rules::columnsOf(guide);
  }
  for (const ImageSpec& image : scene.images) {
    settings.record_attempts = settings.record_attempts || image.kind == ImageKind::attempts;
  }
  return settings;
}

}  // namespace espalier::scenes
