#pragma once
// Small worlds, and what it means that two are the same.
#include <string>

#include "sim/world/world.h"

namespace espalier::tests {

inline sim::Frame unitFrame(sim::Voxel size) {
  return {.origin_m = sim::Vec3(0.0), .voxel_m = 1.0, .size = size};
}

inline sim::Part scenePart(std::string object) {
  sim::Part part;
  part.object = std::move(object);
  return part;
}

inline sim::Part stemPart(std::string object) {
  sim::Part part = scenePart(std::move(object));
  part.kind = sim::PartKind::stem;
  part.plant = 0;
  return part;
}

inline sim::Part elementPart(std::string object) {
  sim::Part part = stemPart(std::move(object));
  part.kind = sim::PartKind::element;
  return part;
}

/// Whether the bricks that a world keeps are those of what takes light in it.
inline bool keepsItsBricks(const sim::World& world) {
  return world.opaqueBricks().bits().words() == sim::Bricks(world.opaque()).bits().words();
}

/// The first thing in which two worlds differ; empty where they are the same.
inline std::string differenceOf(const sim::World& a, const sim::World& b) {
  if (!(a.frame() == b.frame())) return "frame";
  if (a.occupied().words() != b.occupied().words()) return "occupied voxels";
  if (a.solid().words() != b.solid().words()) return "solid voxels";
  if (a.opaque().words() != b.opaque().words()) return "opaque voxels";
  if (a.opaqueBricks().bits().words() != b.opaqueBricks().bits().words()) return "opaque bricks";
  const auto at = [](const char* what, sim::Voxel v) {
    return std::string(what) + " at " + std::to_string(v.x) + " " + std::to_string(v.y) + " " +
           std::to_string(v.z);
  };
  const auto surfaces_a = a.surfaces(), surfaces_b = b.surfaces();
  if (surfaces_a.size() != surfaces_b.size()) return "number of surfaces";
  for (std::size_t i = 0; i < surfaces_a.size(); ++i) {
    const auto& [voxel_a, s] = surfaces_a[i];
    const auto& [voxel_b, t] = surfaces_b[i];
    const bool same = voxel_a == voxel_b && s.part == t.part && s.colour == t.colour &&
                      s.coverage == t.coverage && s.normal == t.normal && s.offset_vx == t.offset_vx;
    if (!same) return at("surface", voxel_a);
  }
  const sim::Voxel size = a.frame().size;
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        const auto m = a.nearnessAt({x, y, z});
        const auto n = b.nearnessAt({x, y, z});
        const bool same =
            m.has_value() == n.has_value() &&
            (!m || (m->layer == n->layer && m->part == n->part && m->distance_vx == n->distance_vx));
        if (!same) return at("nearness", {x, y, z});
        if (a.nearSteps().at({x, y, z}) != b.nearSteps().at({x, y, z})) return at("near steps", {x, y, z});
      }
    }
  }
  return "";
}

}  // namespace espalier::tests
