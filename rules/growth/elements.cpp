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

bool before(sim::Voxel a, sim::Voxel b) {
  return std::tie(a.y, a.z, a.x) < std::tie(b.y, b.z, b.x);
}

/// A natural attitude: the face turns towards the open and the light, as a leaf's blade does, and the element
/// points outwards and a little down, as its own weight and its stalk make it.
void turn(sim::PlacedElement& element, const Senses& senses, sim::Vec3 stem, double face, sim::Draws& draws) {
  const sim::Vec3 light = senses.light == sim::Vec3(0.0) ? sim::Vec3(0, 1, 0) : senses.light;
  const sim::Vec3 open = glm::normalize(0.9 * senses.away + 0.8 * light + 1e-6 * sim::Vec3(0, 1, 0));
  const sim::Vec3 chance = draws.onSphere();
  const sim::Vec3 facing = glm::mix(chance, open, face);
  element.z = glm::length(facing) > 1e-6 ? glm::normalize(facing) : open;
  const sim::Vec3 outward = draws.onSphere() + 0.6 * senses.away - 0.45 * sim::Vec3(0, 1, 0) + 0.15 * stem;
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

std::vector<sim::ProposedElement> proposeElements(const sim::GrowthView& view, const RuleSet& rules,
                                                  const Senses& senses, sim::Vec3 to_vx,
                                                  const std::vector<sim::Voxel>& segment,
                                                  std::int32_t first_shape, const sim::RandomKey& key) {
  std::vector<sim::ProposedElement> placed;
  std::vector<sim::Voxel> taken;  // by elements of this very proposal
  std::vector<sim::Voxel> tiled;
  std::vector<sim::Vec3> corners;
  const auto has = [](const std::vector<sim::Voxel>& voxels, sim::Voxel v) {
    return std::find(voxels.begin(), voxels.end(), v) != voxels.end();
  };
  const sim::Vec3 stem = glm::normalize(to_vx - senses.at_vx);
  for (std::size_t shape = 0; shape < rules.elements.size(); ++shape) {
    const Element& rule = rules.elements[shape];
    sim::Draws count_draws(key, sim::Purpose::element, static_cast<std::uint32_t>(shape << 10));
    const double expected =
        evaluate(rule.per_segment, senses.circumstance, count_draws.uniform()) * senses.vigour;
    const int count = static_cast<int>(std::floor(expected + count_draws.uniform()));
    double area = 0.0;
    for (const auto& polygon : rule.polygons) area += areaOf(polygon);
    for (int i = 0; i < count; ++i) {
      sim::Draws draws(key, sim::Purpose::element,
                       static_cast<std::uint32_t>((shape << 10) + 1) + static_cast<std::uint32_t>(i));
      for (int trial = 0; trial < rule.trials; ++trial) {
        sim::PlacedElement element;
        element.shape = first_shape + static_cast<std::int32_t>(shape);
        element.position_vx = glm::mix(senses.at_vx, to_vx, draws.uniform(0.1, 1.0));
        element.exposure = static_cast<float>(senses.exposure);
        element.scale = evaluate(rule.size, senses.circumstance, draws.uniform()) * senses.vigour;
        turn(element, senses, stem, evaluate(rule.face, senses.circumstance, draws.uniform()), draws);
        tiled.clear();
        for (const auto& polygon : rule.polygons) {
          corners.clear();
          for (const sim::Vec3 corner : polygon) corners.push_back(sim::placed(element, corner));
          sim::tilePolygon(corners, tiled);
        }
        std::sort(tiled.begin(), tiled.end(), before);
        tiled.erase(std::unique(tiled.begin(), tiled.end()), tiled.end());
        // Its own segment is no obstacle, but its siblings are.
        std::erase_if(tiled, [&](sim::Voxel v) { return has(segment, v); });
        if (std::any_of(tiled.begin(), tiled.end(), [&](sim::Voxel v) { return has(taken, v); })) continue;
        std::vector<sim::Voxel> takes;
        if (sim::fit(view.world, tiled, senses.attachment, sim::Passage::around, takes) != sim::Fit::clear)
          continue;
        taken.insert(taken.end(), takes.begin(), takes.end());
        const double share = area * element.scale * element.scale /
                             static_cast<double>(std::max<std::size_t>(1, takes.size()));
        placed.push_back({element, std::move(takes), static_cast<float>(std::min(1.0, share))});
        break;
      }
    }
  }
  return placed;
}

}  // namespace espalier::rules
