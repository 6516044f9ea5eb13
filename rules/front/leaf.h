#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "rules/front/attractors.h"
#include "sim/base/vec.h"

namespace espalier::rules {

/// The most attractors that a leaf of their tree holds.
inline constexpr std::size_t kLeaf = kMostInLeaf;

/// Nodes, coordinate by coordinate, and their numbers.
struct PointList {
  const double *x, *y, *z;
  const std::int32_t* number;
};

/// A leaf's attractors while new nodes come by; what lies behind `count` up to a whole vector is not looked
/// at.
struct Leaf {
  static constexpr std::size_t kPadding = 16, kRoom = kLeaf + kPadding;
  std::size_t count = 0;
  alignas(64) double x[kRoom], y[kRoom], z[kRoom];
  alignas(64) double nearest2[kRoom];  ///< see Attractors
  alignas(64) double nearest[kRoom];   ///< its node's number
  alignas(64) double new2[kRoom];      ///< squared distance from the nearest of the new nodes
};

/// Lets new nodes come by in their order, `which` of them: an attractor goes over to one to which it is
/// nearer than to its own, and nearer than the square root of `influence2`. In SIMD lanes; the same bits as
/// distance2.
void comeBy(Leaf& leaf, std::span<const std::int64_t> which, PointList points, double influence2);

/// Those of the points `which` whose squared distance from a box is less than `within2`, in their order,
/// appended to them: `which` has room for as many again and a whole vector. How many they are. For pruning: a
/// distance comes out up to 1e-14 of it too small, and never larger than distance2 from anything in the box.
std::size_t nearBox(PointList points, std::int64_t* which, std::size_t count, sim::Vec3 low, sim::Vec3 high,
                    double within2);

}  // namespace espalier::rules
