#include "rules/growth/elements.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/sense/intersection.h"
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

bool before(sim::Voxel a, sim::Voxel b) {
  return std::tie(a.y, a.z, a.x) < std::tie(b.y, b.z, b.x);
}

/// Whether a voxel is among some that are in order.
bool among(const Voxels& sorted, sim::Voxel v) {
  return std::binary_search(sorted.begin(), sorted.end(), v, before);
}

/// The voxels of an element, in order and each once. False, and nothing was tiled, where a corner lies
/// outside the world: the rule language allows elements that are far larger than that.
bool tileInside(sim::Voxel world_size, const sim::PlacedElement& element, const Element& rule,
                Voxels& tiled) {
  for (const auto& polygon : rule.polygons) {
    for (const sim::Vec3 corner : polygon) {
      if (!sim::contains(world_size, sim::voxelAt(sim::placed(element, corner)))) return false;
    }
  }
  tiled.clear();
  std::vector<sim::Vec3> corners;
  for (const auto& polygon : rule.polygons) {
    corners.clear();
    for (const sim::Vec3 corner : polygon) corners.push_back(sim::placed(element, corner));
    sim::tilePolygon(corners, tiled);
  }
  std::sort(tiled.begin(), tiled.end(), before);
  tiled.erase(std::unique(tiled.begin(), tiled.end()), tiled.end());
  return true;
}

/// Where each of an element trial's random numbers stands (sim::Slots).
enum ElementSlot : unsigned { kAlong, kSize, kFace, kChanceTurn, kChanceHeight, kOutTurn, kOutHeight };

sim::Vec3 onSphere(sim::Slots& slots, ElementSlot turn, ElementSlot height) {
  return sim::inCone(sim::Vec3(0, 1, 0), -1.0, slots.uniform(turn), slots.uniform(height));
}

/// A natural attitude: the face turns towards the open and the light, as a leaf's blade does, and the element
/// points outwards and a little down, as its own weight and its stalk make it.
void turn(sim::PlacedElement& element, const Surroundings& around, const Senses& senses, sim::Vec3 stem,
          double face, sim::Slots& slots) {
  const sim::Vec3 light = senses.light == sim::Vec3(0.0) ? sim::Vec3(0, 1, 0) : senses.light;
  const sim::Vec3 open = glm::normalize(0.9 * around.away + 0.8 * light + 1e-6 * sim::Vec3(0, 1, 0));
  const sim::Vec3 facing = glm::mix(onSphere(slots, kChanceTurn, kChanceHeight), open, face);
  element.z = glm::length(facing) > 1e-6 ? glm::normalize(facing) : open;
  const sim::Vec3 outward =
      onSphere(slots, kOutTurn, kOutHeight) + 0.6 * around.away - 0.45 * sim::Vec3(0, 1, 0) + 0.15 * stem;
  const sim::Vec3 in_blade = outward - glm::dot(outward, element.z) * element.z;
  element.y = glm::length(in_blade) > 1e-6 ? glm::normalize(in_blade) : sim::perpendicular(element.z);
  element.x = glm::cross(element.y, element.z);
}

}  // namespace

std::vector<sim::ElementShape> shapesOf(const RuleSet& rules) {
  std::vector<sim::ElementShape> shapes;
  for (const Element& element : rules.elements)
    shapes.push_back({element.name, element.polygons, element.colour});
  return shapes;
}

std::vector<sim::ProposedElement> proposeElements(const sim::SiteView& view, const RuleSet& rules,
                                                  const Surroundings& around, const Senses& senses,
                                                  sim::Vec3 to_vx, const std::vector<sim::Voxel>& segment,
                                                  std::int32_t first_shape, const sim::RandomKey& key) {
  std::vector<sim::ProposedElement> placed;
  Voxels own = segment, taken, tiled;  // taken: by elements of this very proposal, in order
  std::sort(own.begin(), own.end(), before);
  const sim::Vec3 stem = glm::normalize(to_vx - around.at_vx);
  for (std::size_t shape = 0; shape < rules.elements.size(); ++shape) {
    const Element& rule = rules.elements[shape];
    sim::Slots counting(key, sim::Purpose::element_count, static_cast<unsigned>(shape));
    const double expected =
        evaluate(rule.per_segment, senses.circumstance, counting.uniform(0)) * senses.vigour;
    const auto count = static_cast<unsigned>(std::floor(expected + counting.uniform(1)));
    double area = 0.0;
    for (const auto& polygon : rule.polygons) area += areaOf(polygon);
    for (unsigned i = 0; i < count; ++i) {
      for (int trial = 0; trial < rule.trials; ++trial) {
        // The rule language allows 64 shapes, and 1000 of each: 100 a segment, ten times as many in full
        // light.
        sim::Slots slots(key, sim::Purpose::element, static_cast<unsigned>(shape << 10) + i,
                         static_cast<unsigned>(trial));
        sim::PlacedElement element;
        element.shape = first_shape + static_cast<std::int32_t>(shape);
        element.position_vx = glm::mix(around.at_vx, to_vx, 0.1 + 0.9 * slots.uniform(kAlong));
        element.exposure = static_cast<float>(senses.exposure);
        element.scale = evaluate(rule.size, senses.circumstance, slots.uniform(kSize)) * senses.vigour;
        turn(element, around, senses, stem, evaluate(rule.face, senses.circumstance, slots.uniform(kFace)),
             slots);
        if (!tileInside(view.world.frame().size, element, rule, tiled)) continue;
        // The world is frozen: the element's own segment and its siblings do not stand there yet. The one is
        // no obstacle, the others are.
        std::erase_if(tiled, [&](sim::Voxel v) { return among(own, v); });
        Voxels takes;
        if (sim::fit(view.world, tiled, around.attachment, sim::Passage::around, sim::kNoPlant, takes) != sim::Fit::clear)
          continue;
        if (std::any_of(takes.begin(), takes.end(), [&](sim::Voxel v) { return among(taken, v); })) continue;
        const auto middle = taken.insert(taken.end(), takes.begin(), takes.end());
        std::inplace_merge(taken.begin(), middle, taken.end(), before);
        const double share = area * element.scale * element.scale /
                             static_cast<double>(std::max<std::size_t>(1, takes.size()));
        placed.push_back(
            {element, std::move(takes), sim::Passage::around, static_cast<float>(std::min(1.0, share))});
        break;
      }
    }
  }
  return placed;
}

}  // namespace espalier::rules
