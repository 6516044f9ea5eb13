#pragma once
#include <vector>

#include "sim/grow/plant.h"
#include "sim/tile/tiling.h"
#include "tests/support/plain_crossing.h"

/// Which of plants' elements cross each other or are pierced, found by asking of all pairs.
namespace espalier::tests {

struct PlainElement {
  sim::LatticeBox box;
  std::vector<sim::LatticeTriangle> triangles;
};

/// The fans that tiling makes of an element's polygons.
inline PlainElement plain(const sim::PlacedElement& element, const sim::ElementShape& shape) {
  PlainElement result;
  for (const auto& polygon : shape.polygons) {
    std::vector<sim::LatticePoint> corners;
    for (const sim::Vec3 corner : polygon)
      corners.push_back(sim::LatticePoint(sim::fixedFromVoxel(sim::placed(element, corner))));
    if (result.triangles.empty()) result.box = {corners[0], corners[0]};
    for (const auto corner : corners)
      result.box = {glm::min(result.box.low, corner), glm::max(result.box.high, corner)};
    for (std::size_t i = 2; i < corners.size(); ++i)
      result.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
  return result;
}

inline bool plainlyCross(const PlainElement& a, const PlainElement& b) {
  if (!sim::meet(a.box, b.box)) return false;
  for (const auto& t : a.triangles) {
    for (const auto& u : b.triangles) {
      if (plainlyCross(t, u)) return true;
    }
  }
  return false;
}

inline bool plainlyPierces(sim::Vec3 from, sim::Vec3 to, const PlainElement& element) {
  const sim::LatticePoint p(sim::fixedFromVoxel(from)), q(sim::fixedFromVoxel(to));
  if (!sim::meet(sim::boxOf(p, q), element.box)) return false;
  for (const auto& t : element.triangles) {
    if (plainlyPierces(p, q, t)) return true;
  }
  return false;
}

/// Pairs of elements, of any plants, that cross each other.
inline std::size_t crossings(const std::vector<sim::Plant>& plants) {
  std::vector<PlainElement> elements;
  for (const sim::Plant& plant : plants) {
    for (const auto& e : plant.elements)
      elements.push_back(plain(e, plant.shapes[static_cast<std::size_t>(e.shape)]));
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) count += plainlyCross(elements[i], elements[k]);
  }
  return count;
}

/// Pairs of an element and a limb, of any plants, that pierces it, is not its own and stood before it.
inline std::size_t piercings(const std::vector<sim::Plant>& plants) {
  std::size_t count = 0;
  for (const sim::Plant& plant : plants) {
    for (const auto& e : plant.elements) {
      const PlainElement element = plain(e, plant.shapes[static_cast<std::size_t>(e.shape)]);
      for (const sim::Plant& other : plants) {
        const sim::Skeleton& s = other.skeleton;
        for (std::size_t i = 1; i < s.parent.size(); ++i) {
          const auto from = s.position_vx[static_cast<std::size_t>(s.parent[i])];
          count += s.born[i] < e.born && plainlyPierces(from, s.position_vx[i], element);
        }
      }
    }
  }
  return count;
}

}  // namespace espalier::tests
