#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "render/model/spline.h"

namespace espalier::render {

/// Whether a place, in voxel space, is in something.
using Blocked = std::function<bool(sim::Vec3)>;

/// A smooth line through a stem's nodes: node i at parameter i. It is a centripetal spline: it takes the root
/// of a segment's length from node to node (Lee 1989), so that it neither swings out nor loops where short
/// segments meet long ones. Where that would enter what the straight segments leave free, the spline passes
/// through points of the segments too, as many as it takes, and where sixteen to a segment are not enough,
/// the segment is straight.
class StemLine {
 public:
  StemLine() = default;  ///< to be given nodes later
  /// At least two points. `start_derivative` as for Spline, by the parameter here.
  StemLine(std::span<const sim::Vec3> points, std::optional<sim::Vec3> start_derivative,
           const Blocked& blocked);

  double last() const { return static_cast<double>(points_.size()) - 1.0; }
  /// 0 <= t <= last()
  sim::Vec3 position(double t) const;
  sim::Vec3 derivative(double t) const;

 private:
  struct Place {
    std::size_t segment;
    double share;
  };
  Place placeAt(double t) const;
  bool enters(std::size_t segment, const Blocked& blocked) const;

  std::vector<sim::Vec3> points_;
  Spline spline_;
  std::vector<double> knots_;   // the spline's parameter of each node
  std::vector<bool> straight_;  // segments; empty: none is
};

}  // namespace espalier::render
