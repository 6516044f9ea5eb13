#include "rules/growth/elements.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "rules/growth/element_places.h"
#include "sim/base/stop.h"
#include "sim/grow/pieces.h"
#include "sim/tile/tiling.h"

namespace espalier::rules {
namespace {

/// Area of a planar polygon, square voxel widths.
double areaOf(const std::vector<sim::Vec3>& corners) {
  sim::Vec3 sum(0.0);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    sum += glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  }
  return 0.5 * glm::length(sum);
}

using Voxels = std::vector<sim::Voxel>;

/// Whether a voxel is among some that are in order.
bool among(const Voxels& sorted, sim::Voxel v) {
  return std::binary_search(sorted.begin(), sorted.end(), v, sim::beforeInRows);
}

/// Takes the scene's voxels out of an element's. False where there is one that its own segment does not pass.
bool clearOfScene(const sim::World& world, const Voxels& own, Voxels& tiled) {
  bool clear = true;
  std::erase_if(tiled, [&](sim::Voxel v) {
    const bool scene = isScene(world, v);
    clear = clear && (!scene || among(own, v));
    return scene;
  });
  return clear;
}

/// Bounds of all that could be placed on a segment.
sim::LatticeBox reachOf(const sim::SiteView& view, const RuleSet& rules, double vigour,
                        std::int32_t first_shape, sim::Vec3 from_vx, sim::Vec3 to_vx) {
  double reach = 0.0;
  for (std::size_t i = 0; i < rules.elements.size(); ++i) {
    const auto part = view.plant.element_parts[static_cast<std::size_t>(first_shape) + i];
    double away_vx = highest(rules.elements[i].petiole.value);
    if (liesFlat(rules.elements[i].pose)) away_vx += kMostLift;
    for (const sim::Vec3 corner : view.pieces.shapeOf(part).corners)
      reach = std::max(reach, away_vx + glm::length(corner) * highest(rules.elements[i].size) * vigour);
  }
  const sim::Vec3 rim(sim::Vec3(view.world.frame().size));
  const sim::Vec3 most(reach + 1e-3);
  return {sim::latticePoint(glm::max(glm::min(from_vx, to_vx) - most, sim::Vec3(-1.0))),
          sim::latticePoint(glm::min(glm::max(from_vx, to_vx) + most, rim))};
}

/// Where elements of a shape go on a segment that begins at a place of its limb: as many places as there are
/// to be elements.
std::vector<ElementPlace> placesOn(const Element& rule, const Senses& senses, const LimbPlace& begins,
                                   sim::Vec3 stem, double length_vx, unsigned shape,
                                   const sim::RandomKey& key) {
  if (rule.phyllotaxis) {
    const LimbQuantities end = atEnd(begins, stem, length_vx);
    return placesInOrder(*rule.phyllotaxis, begins.length_vx, static_cast<double>(end.length_vx));
  }
  sim::Slots counting(key, sim::Purpose::element_count, shape);
  const double expected =
      evaluate(rule.per_segment, senses.circumstance, counting.uniform(0)) * senses.vigour;
  return std::vector<ElementPlace>(static_cast<std::size_t>(std::floor(expected + counting.uniform(1))));
}

}  // namespace

bool isScene(const sim::World& world, sim::Voxel v) {
  return world.solid().at(v) && world.part(world.partAt(v)).kind == sim::PartKind::scene;
}

std::vector<sim::ElementShape> shapesOf(const RuleSet& rules) {
  std::vector<sim::ElementShape> shapes;
  for (const Element& element : rules.elements) {
    shapes.push_back({element.name, element.polygons, element.colour, element.varies,
                      element.picture ? "" : element.texture, element.picture, element.body,
                      element.emits ? element.emits->light() : sim::Colour(0.0f),
                      static_cast<float>(element.alpha)});
  }
  return shapes;
}

std::vector<sim::ProposedElement> proposeElements(const sim::SiteView& view, const sim::Site& site,
                                                  const RuleSet& rules, const Surroundings& around,
                                                  const Senses& senses, sim::Vec3 to_vx,
                                                  const std::vector<sim::Voxel>& segment,
                                                  std::int32_t first_shape, const sim::RandomKey& key) {
  std::vector<sim::ProposedElement> placed;
  Voxels own = segment, tiled;
  std::sort(own.begin(), own.end(), sim::beforeInRows);
  const sim::Vec3 stem = glm::normalize(to_vx - around.at_vx);
  // What stands, and elements of this very proposal. They keep their memory.
  thread_local sim::Nearby nearby;
  thread_local sim::Facets facets;
  nearby.clear();
  if (!rules.elements.empty())
    view.pieces.gather(reachOf(view, rules, senses.vigour, first_shape, around.at_vx, to_vx), 0, -1, nearby);
  for (std::size_t shape = 0; shape < rules.elements.size(); ++shape) {
    const Element& rule = rules.elements[shape];
    const auto number = first_shape + static_cast<std::int32_t>(shape);
    const sim::FacetShape& facet_shape =
        view.pieces.shapeOf(view.plant.element_parts[static_cast<std::size_t>(number)]);
    LimbPlace begins;
    if (rule.phyllotaxis) begins = limbPlace(view.plant.skeleton, site.node, stem);
    const std::vector<ElementPlace> places = placesOn(
        rule, senses, begins, stem, glm::distance(to_vx, around.at_vx), static_cast<unsigned>(shape), key);
    double area = 0.0;
    for (const auto& polygon : rule.polygons) area += rule.opacity * areaOf(polygon);
    for (unsigned i = 0; i < places.size(); ++i) {
      for (int trial = 0; trial < rule.trials; ++trial) {
        sim::throwIfStopped();
        // The rule language allows 64 shapes, and 1000 of each.
        sim::Slots slots(key, sim::Purpose::element, static_cast<unsigned>(shape << 10) + i,
                         static_cast<unsigned>(trial));
        sim::PlacedElement element;
        element.shape = number;
        const double along = places[i].in_order ? places[i].along : 0.1 + 0.9 * slots.uniform(kAlong);
        element.position_vx = glm::mix(around.at_vx, to_vx, along);
        element.exposure = static_cast<float>(senses.exposure);
        element.scale = evaluate(rule.size, senses.circumstance, slots.uniform(kSize)) * senses.vigour;
        const sim::Vec3 surface =
            liesFlat(rule.pose) ? surfaceNormal(view.world, element.position_vx) : sim::Vec3(0.0);
        stand(element, rule, places[i], stem, begins.across, around, senses, surface, trial, slots);
        // The cheap questions first. The world is frozen: the element's own segment does not stand there yet.
        if (!sim::place(element, facet_shape, facets) || !sim::inside(view.world.frame().size, facets) ||
            (!rule.crosses && nearby.clash(facets, {sim::latticePoint(element.position_vx)})))
          continue;
        tiled.clear();
        sim::tileTriangles(facets.corners, facet_shape.triangles, tiled);
        if (!clearOfScene(view.world, own, tiled)) continue;
        if (!rule.crosses) nearby.add(facets);
        const double share = area * element.scale * element.scale /
                             static_cast<double>(std::max<std::size_t>(1, tiled.size()));
        placed.push_back({element, tiled, rule.crosses ? sim::Passage::through : sim::Passage::around,
                          static_cast<float>(std::min(1.0, share))});
        break;
      }
    }
  }
  return placed;
}

}  // namespace espalier::rules
