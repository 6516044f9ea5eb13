#include "sim/scatter/envelope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/error.h"
#include "sim/scatter/slices.h"

namespace espalier::sim {
namespace {

/// Throws where a size is no number or not above zero. A comparison that is false for what is no number.
void requireAbove(double size, const char* what) {
  if (size > 0.0 && std::isfinite(size)) return;
  throw InputError(
      fmt::format("an envelope with a {} of {}; expected a number above 0, or it is empty", what, size));
}

struct Sound {
  void operator()(const Cone& c) const {
    requireAbove(c.height, "height");
    requireAbove(c.radius, "radius");
  }
  void operator()(const Dome& d) const { requireAbove(d.radius, "radius"); }
  void operator()(const Cylinder& c) const {
    requireAbove(c.height, "height");
    requireAbove(c.radius, "radius");
  }
  void operator()(const Sphere& s) const { requireAbove(s.radius, "radius"); }
  void operator()(const Ellipsoid& e) const {
    for (int axis = 0; axis < 3; ++axis) requireAbove(e.radii[axis], "radius");
  }
  void operator()(const Box& b) const {
    for (int axis = 0; axis < 3; ++axis) requireAbove(b.size[axis], "size");
  }
  void operator()(const Revolution& r) const {
    double widest = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double height = r.profile[i].x, radius = r.profile[i].y;
      if (!std::isfinite(height) || !(radius >= 0.0) || !std::isfinite(radius)) {
        throw InputError(fmt::format(
            "a profile with the point [{}, {}]; expected numbers, and radii of 0 or more", height, radius));
      }
      if (i > 0 && height < r.profile[i - 1].x) {
        throw InputError(
            fmt::format("a profile with the height {} after {}; expected heights that do not "
                        "fall",
                        height, r.profile[i - 1].x));
      }
      widest = std::max(widest, radius);
    }
    if (!(r.profile[3].x > r.profile[0].x) || widest == 0.0) {
      throw InputError("a profile without an inside; expected heights that rise and a radius above 0");
    }
  }
};

struct Volume {
  double operator()(const Cone& c) const { return std::numbers::pi * c.radius * c.radius * c.height / 3.0; }
  double operator()(const Dome& d) const { return (*this)(revolutionOf(d)); }
  double operator()(const Cylinder& c) const { return std::numbers::pi * c.radius * c.radius * c.height; }
  double operator()(const Sphere& s) const { return (*this)(Ellipsoid{Vec3(s.radius)}); }
  double operator()(const Ellipsoid& e) const {
    return 4.0 / 3.0 * std::numbers::pi * e.radii.x * e.radii.y * e.radii.z;
  }
  double operator()(const Box& b) const { return b.size.x * b.size.y * b.size.z; }
  double operator()(const Revolution& r) const {  // Simpson's rule on a polynomial of degree 8
    constexpr int kSteps = 512;
    double sum = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
      const Slice slice = sliceAt(r, static_cast<double>(i) / kSteps);
      const double weight = i == 0 || i == kSteps ? 1.0 : i % 2 == 0 ? 2.0 : 4.0;
      sum += weight * slice.half.x * slice.half.x * slice.rise;
    }
    return std::numbers::pi * sum / (3.0 * kSteps);
  }
};

/// The largest value of a cubic Bezier polynomial on [0, 1]: at an end, or where its slope is zero.
double largest(const std::array<double, 4>& at) {
  double most = std::max(at[0], at[3]);
  const double a = at[1] - at[0], b = at[2] - at[1], c = at[3] - at[2];
  const double square = a - 2.0 * b + c, linear = 2.0 * (b - a);  // slope: square s^2 + linear s + a
  const auto look = [&](double s) {
    if (s > 0.0 && s < 1.0) most = std::max(most, bezier(at, s));
  };
  if (square == 0.0) {
    if (linear != 0.0) look(-a / linear);
    return most;
  }
  const double root = std::sqrt(std::max(0.0, linear * linear - 4.0 * square * a));
  look((-linear - root) / (2.0 * square));
  look((-linear + root) / (2.0 * square));
  return most;
}

struct Widest {
  glm::dvec2 operator()(const Cone& c) const { return glm::dvec2(c.radius); }
  glm::dvec2 operator()(const Dome& d) const { return glm::dvec2(d.radius); }
  glm::dvec2 operator()(const Cylinder& c) const { return glm::dvec2(c.radius); }
  glm::dvec2 operator()(const Sphere& s) const { return glm::dvec2(s.radius); }
  glm::dvec2 operator()(const Ellipsoid& e) const { return {e.radii.x, e.radii.z}; }
  glm::dvec2 operator()(const Box& b) const { return 0.5 * glm::dvec2(b.size.x, b.size.z); }
  glm::dvec2 operator()(const Revolution& r) const {
    return glm::dvec2(largest({r.profile[0].y, r.profile[1].y, r.profile[2].y, r.profile[3].y}));
  }
};

}  // namespace

void requireSound(const Envelope& envelope) {
  const Vec3& foot = envelope.foot;
  if (!std::isfinite(foot.x) || !std::isfinite(foot.y) || !std::isfinite(foot.z))
    throw InputError("an envelope whose foot is no place; expected three numbers");
  std::visit(Sound{}, envelope.solid);
}

bool contains(const Envelope& envelope, Vec3 point) {
  const Vec3 p = point - envelope.foot;
  const double low = sliceAt(envelope.solid, 0.0).height, high = sliceAt(envelope.solid, 1.0).height;
  if (!(p.y >= low && p.y <= high)) return false;
  const glm::dvec2 half = sliceAt(envelope.solid, sliceOf(envelope.solid, p.y)).half;
  if (isSquare(envelope.solid)) return std::abs(p.x) <= half.x && std::abs(p.z) <= half.y;
  if (!(half.x > 0.0 && half.y > 0.0)) return p.x == 0.0 && p.z == 0.0;
  const double x = p.x / half.x, z = p.z / half.y;
  return x * x + z * z <= 1.0;
}

EnvelopeBounds boundsOf(const Envelope& envelope) {
  const glm::dvec2 half = std::visit(Widest{}, envelope.solid);
  return {envelope.foot + Vec3(-half.x, sliceAt(envelope.solid, 0.0).height, -half.y),
          envelope.foot + Vec3(half.x, sliceAt(envelope.solid, 1.0).height, half.y)};
}

double volumeOf(const Envelope& envelope) {
  return std::visit(Volume{}, envelope.solid);
}

}  // namespace espalier::sim
