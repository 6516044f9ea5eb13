#include "sim/scatter/slices.h"

#include <algorithm>
#include <cmath>

namespace espalier::sim {
namespace {

std::array<double, 4> heightsOf(const Revolution& r) {
  return {r.profile[0].x, r.profile[1].x, r.profile[2].x, r.profile[3].x};
}
std::array<double, 4> radiiOf(const Revolution& r) {
  return {r.profile[0].y, r.profile[1].y, r.profile[2].y, r.profile[3].y};
}

/// How wide a ball of radius 1 is, by the share of its height.
double widthOfBall(double s) {
  return 2.0 * std::sqrt(std::max(0.0, s * (1.0 - s)));
}

struct Cut {
  double s;

  Slice operator()(const Cone& c) const { return {s * c.height, c.height, glm::dvec2((1.0 - s) * c.radius)}; }
  Slice operator()(const Dome& d) const { return (*this)(revolutionOf(d)); }
  Slice operator()(const Cylinder& c) const { return {s * c.height, c.height, glm::dvec2(c.radius)}; }
  Slice operator()(const Sphere& b) const { return (*this)(Ellipsoid{Vec3(b.radius)}); }
  Slice operator()(const Ellipsoid& e) const {
    return {s * 2.0 * e.radii.y, 2.0 * e.radii.y, widthOfBall(s) * glm::dvec2(e.radii.x, e.radii.z)};
  }
  Slice operator()(const Box& b) const {
    return {s * b.size.y, b.size.y, 0.5 * glm::dvec2(b.size.x, b.size.z)};
  }
  Slice operator()(const Revolution& r) const {
    const auto heights = heightsOf(r);
    return {bezier(heights, s), bezierSlope(heights, s), glm::dvec2(bezier(radiiOf(r), s))};
  }
};

}  // namespace

double bezier(const std::array<double, 4>& at, double s) {
  const double t = 1.0 - s;
  return t * t * t * at[0] + 3.0 * t * t * s * at[1] + 3.0 * t * s * s * at[2] + s * s * s * at[3];
}

double bezierSlope(const std::array<double, 4>& at, double s) {
  const double t = 1.0 - s;
  return 3.0 * (t * t * (at[1] - at[0]) + 2.0 * t * s * (at[2] - at[1]) + s * s * (at[3] - at[2]));
}

Revolution revolutionOf(const Dome& dome) {
  const double r = dome.radius;
  return {{{{0.0, r}, {r / 3.0, r}, {r * (2.0 / 3.0), r / 2.0}, {r, r / 6.0}}}};
}

Slice sliceAt(const Solid& solid, double s) {
  return std::visit(Cut{s}, solid);
}

double sliceOf(const Solid& solid, double height) {
  if (!std::holds_alternative<Revolution>(solid)) return height / sliceAt(solid, 1.0).height;
  double low = 0.0, high = 1.0;
  while (true) {  // heights do not fall
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) return middle;
    (sliceAt(solid, middle).height < height ? low : high) = middle;
  }
}

bool isSquare(const Solid& solid) {
  return std::holds_alternative<Box>(solid);
}

}  // namespace espalier::sim
