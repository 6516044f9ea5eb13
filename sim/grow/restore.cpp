#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/counted.h"
#include "sim/base/error.h"
#include "sim/grow/pieces.h"
#include "sim/grow/state.h"

namespace espalier::sim {
namespace {

bool finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Near enough to be told by whole voxels.
bool near(Vec3 p_vx) {
  return finite(p_vx) && std::max({std::abs(p_vx.x), std::abs(p_vx.y), std::abs(p_vx.z)}) < 1e9;
}

bool inside(Voxel size, Vec3 p_vx) {
  return near(p_vx) && contains(size, voxelAt(p_vx));
}

bool within(std::int32_t born, int iterations) {
  return born >= 0 && born <= iterations;
}

/// Whether a skeleton is one: a tree whose nodes lie in the world, and came while it grew.
bool sound(const Skeleton& s, Voxel size, int iterations) {
  const std::size_t nodes = s.parent.size();
  if (nodes == 0 || s.position_vx.size() != nodes || s.born.size() != nodes) return false;
  for (const auto& [name, values] : s.columns) {
    if (values.size() != nodes) return false;
  }
  for (std::size_t i = 0; i < nodes; ++i) {
    const NodeId parent = s.parent[i];
    if (parent < kNoNode || parent >= static_cast<NodeId>(i) || (parent == kNoNode) != (i == 0)) return false;
    if (!inside(size, s.position_vx[i]) || !within(s.born[i], iterations)) return false;
  }
  return true;
}

bool sound(const PlacedElement& e, const Plant& plant, const std::vector<FacetShape>& shapes,
           int iterations) {
  if (e.node < 0 || e.node >= plant.skeleton.size() || e.shape < 0 ||
      static_cast<std::size_t>(e.shape) >= plant.shapes.size() || !finite(e.position_vx) || !finite(e.x) ||
      !finite(e.y) || !finite(e.z) || !std::isfinite(e.scale) || !std::isfinite(e.exposure) ||
      !within(e.born, iterations))
    return false;
  Facets facets;
  return place(e, shapes[static_cast<std::size_t>(e.shape)], facets);
}

bool sound(const Surface& s) {
  return finite(Vec3(s.colour)) && std::isfinite(s.coverage) && s.coverage >= 0.0f &&
         finite(Vec3(s.normal)) && std::isfinite(s.offset_vx);
}

std::vector<std::string> namesOf(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const auto& [name, values] : skeleton.columns) names.push_back(name);
  return names;
}

}  // namespace

Growth restore(State state, World& world, const std::vector<Planting>& plantings, const std::string& file) {
  requireProcesses(plantings);
  const auto require = [&](bool holds, const std::string& what) {
    if (!holds) throw InputError(fmt::format("{}: {}", file, what));
  };
  Growth& growth = state.growth;
  const Voxel size = world.frame().size;
  require(state.size == size,
          fmt::format("it was grown in a world of {} x {} x {} voxels; this one has {} x {} x {}",
                      state.size.x, state.size.y, state.size.z, size.x, size.y, size.z));
  require(growth.stands.size() == plantings.size(),
          fmt::format("it holds {}; the scene has {}", counted(growth.stands.size(), "planting"),
                      plantings.size()));
  require(growth.tallies.size() == growth.plants.size() && growth.iterations >= 0,
          "the state is damaged: its counts do not fit its plants");
  std::size_t first = 0;
  for (std::size_t i = 0; i < plantings.size(); ++i) {
    const Stand& stand = growth.stands[i];
    require(stand.count == plantings[i].seeds.size(),
            fmt::format("it holds {} of '{}'; the scene has {}", counted(stand.count, "plant"),
                        plantings[i].name, plantings[i].seeds.size()));
    require(stand.first == first, "the state is damaged: its plants are out of order");
    first += stand.count;
  }
  require(first == growth.plants.size(), "the state is damaged: it holds plants of no planting");

  // All is checked before anything changes.
  std::vector<Part> parts;
  const auto part_of = [&](const std::string& object, const std::string& region, PartKind kind,
                           std::size_t plant) {
    parts.push_back({object, region, kind, static_cast<int>(plant)});
    return static_cast<PartId>(world.parts().size() + parts.size());
  };
  for (std::size_t i = 0; i < plantings.size(); ++i) {
    const Planting& planting = plantings[i];
    const Plant seedling = planting.process->seedling();
    std::vector<FacetShape> shapes;
    for (const ElementShape& shape : seedling.shapes) shapes.push_back(facetShape(shape.polygons));
    for (std::size_t k = 0; k < planting.seeds.size(); ++k) {
      const std::size_t number = growth.stands[i].first + k;
      Plant& plant = growth.plants[number];
      require(plant.key == planting.seeds[k].key,
              fmt::format("seed {} of '{}' has another key or stands elsewhere", k + 1, planting.name));
      // A seedling, grown: what a state does not hold is as its process has it.
      Plant grown = seedling;
      grown.key = plant.key;
      grown.skeleton = std::move(plant.skeleton);
      grown.elements = std::move(plant.elements);
      plant = std::move(grown);
      plant.name = planting.seeds.size() == 1 ? planting.name : fmt::format("{} {}", planting.name, k + 1);
      plant.stem_part = part_of(plant.name, "stem", PartKind::stem, number);
      for (const ElementShape& shape : plant.shapes)
        plant.element_parts.push_back(part_of(plant.name, shape.name, PartKind::element, number));
      require(namesOf(plant.skeleton) == namesOf(seedling.skeleton),
              fmt::format("'{}' keeps other columns than its process does", plant.name));
      require(sound(plant.skeleton, size, growth.iterations),
              fmt::format("the state is damaged: '{}' is no tree", plant.name));
      require(std::all_of(plant.elements.begin(), plant.elements.end(),
                          [&](const PlacedElement& e) { return sound(e, plant, shapes, growth.iterations); }),
              fmt::format("the state is damaged: an element of '{}' stands nowhere", plant.name));
    }
  }
  const auto base = static_cast<PartId>(world.parts().size()) + 1;
  for (auto& [voxel, surface] : state.voxels) {
    require(contains(size, voxel) && !world.occupied().at(voxel),
            "a plant stands where the site has something");
    require(surface.part >= 0 && static_cast<std::size_t>(surface.part) < parts.size(),
            "the state is damaged: a voxel of no plant");
    require(sound(surface), "the state is damaged: what is in a voxel is no number");
    surface.part += base;
  }
  require(std::all_of(growth.attempts.begin(), growth.attempts.end(),
                      [](const Attempt& a) { return near(a.from_vx) && near(a.to_vx); }),
          "the state is damaged: a trial at no place");
  for (Part& part : parts) world.addPart(std::move(part));
  world.occupy(state.voxels);
  return std::move(growth);
}

}  // namespace espalier::sim
