#pragma once
// Small worlds, and what it means that two are the same.
#include <gtest/gtest.h>

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

inline void expectSameWorld(const sim::World& a, const sim::World& b) {
  ASSERT_EQ(a.frame(), b.frame());
  EXPECT_EQ(a.occupied().words(), b.occupied().words());
  EXPECT_EQ(a.solid().words(), b.solid().words());
  EXPECT_EQ(a.opaque().words(), b.opaque().words());
  const auto surfaces_a = a.surfaces();
  const auto surfaces_b = b.surfaces();
  ASSERT_EQ(surfaces_a.size(), surfaces_b.size());
  for (std::size_t i = 0; i < surfaces_a.size(); ++i) {
    const auto& [voxel_a, s] = surfaces_a[i];
    const auto& [voxel_b, t] = surfaces_b[i];
    ASSERT_EQ(voxel_a, voxel_b);
    ASSERT_TRUE(s.part == t.part && s.colour == t.colour && s.coverage == t.coverage &&
                s.normal == t.normal && s.offset_vx == t.offset_vx);
  }
  const sim::Voxel size = a.frame().size;
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        const auto m = a.nearnessAt({x, y, z});
        const auto n = b.nearnessAt({x, y, z});
        ASSERT_EQ(m.has_value(), n.has_value());
        ASSERT_EQ(a.nearSteps().at({x, y, z}), b.nearSteps().at({x, y, z}));
        if (!m) continue;
        ASSERT_TRUE(m->layer == n->layer && m->part == n->part && m->distance_vx == n->distance_vx);
      }
    }
  }
}

}  // namespace espalier::tests
