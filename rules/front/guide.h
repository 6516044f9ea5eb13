#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/base/vec.h"

/// Guide fields (Tanaka et al. 2022, sections 4.3 and 4.4; Tanaka, Ito and Kikuchi 2020, section 3.6):
/// vectors that turn the ways of a front about an axis, so that it whorls.
///
/// At a place P, with S the start of its plant, X_d = (P - S) / |P - S| (equation 9) and the axis n, the
/// papers turn X_d about n by the quaternion q of an angle: X_f = q X_d q* (equations 10 to 12), and grow to
/// P + D n'/|n'| + s X_f (13). Taken literally, a turn by 360 or 720 degrees is none. Here the turn builds up
/// with the distance r from the start: X_f is X_d + (angle / R) n x (P - S), normalized, R being how far the
/// farthest attractor of that start is. In a plane about n that is a turn of X_d by atan(angle r / R). So a
/// way that follows X_f alone has wound about n by `angle` when it comes to R, as an Archimedean spiral: more
/// angle, tighter whorls, and never back to the start. The step stays D long: the sum of n'/|n'| and s X_f is
/// normalized. With s = 0 it is plain colonization.
namespace espalier::rules {

enum class GuideAxis : std::int32_t {
  node_normal,  ///< the surface's normal where the node is: that of the attractor nearest to it, whatever
                ///< became of it
  attractor_normal,  ///< that of the attractor which it pulls most: the nearest that waits for it
  direction,         ///< the same everywhere
  grid               ///< of a grid of vectors
};

/// About this place the field is another one: the nearer, the more.
struct GuidePoint {
  sim::Vec3 at{0.0};
  double radius = 1.0;
  double angle_deg = 0.0;
  double strength = 0.0;
};

/// Vectors at the points of a lattice, between which they are linear; x fastest, then y, then z.
struct GuideGrid {
  sim::Vec3 low{0.0};
  double apart = 1.0;
  std::array<std::int32_t, 3> size{0, 0, 0};
  std::span<const sim::Vec3> vectors;  ///< borrowed
};

/// A part of space, in cubes about the points of a lattice; x fastest, then y, then z, 64 a word.
struct GuideRegion {
  sim::Vec3 low{0.0};  ///< the middle of the first
  double apart = 1.0;
  std::array<std::int32_t, 3> size{0, 0, 0};
  std::span<const std::int64_t> words;  ///< borrowed

  bool holds(sim::Vec3 at) const;
};

struct Guide {
  double angle_deg =
      0.0;  ///< by which ways wind from the start to the farthest attractor; below 0 the other way round
  double strength = 1.0;  ///< s
  GuideAxis axis = GuideAxis::direction;
  sim::Vec3 direction{0, 1, 0};  ///< of GuideAxis::direction
  bool follows_normal = false;   ///< strength times the axis' length
  std::vector<GuidePoint> points;
  std::optional<std::array<sim::Vec3, 2>> box;       ///< holds in here alone: least and greatest corner
  std::optional<GuideRegion> region;                 ///< and in here alone
  std::array<std::int32_t, 2> orders{0, 1'000'000};  ///< of segments for which it holds: from, to
  GuideGrid grid;
};

/// Where a way begins, as a field sees it.
struct GuidePlace {
  sim::Vec3 at{0.0};
  sim::Vec3 start{0.0};
  double farthest = 0.0;  ///< R
  sim::Vec3 normal{0.0};  ///< of GuideAxis::node_normal and attractor_normal
  std::int32_t order = 0;
};

/// s X_f there; zero where the field says nothing: outside its box, its region or its orders, at the start
/// itself, where no axis is known. About normals the field lies in the plane that they stand on.
sim::Vec3 guideAt(const Guide& guide, const GuidePlace& place);

/// The way of a node that is pulled along a unit vector: n'/|n'| + s X_f, normalized; the pull itself, to the
/// bit, where there is no guide.
sim::Vec3 guidedWay(sim::Vec3 pull, sim::Vec3 guide);

}  // namespace espalier::rules
