#pragma once
#include <cstdint>
#include <vector>

#include "render/model/tubes.h"

namespace espalier::render {

/// Where a limb stands on the surface of the one that it leaves: an ellipse in the chart of that limb's
/// distance along and angle around.
struct Foot {
  double arc_m = 0.0, angle = 0.0;  ///< its middle; radians from the section's `across` towards `up`
  double half_arc_m = 0.0, half_angle = 0.0;
};

/// A stem as a tube in world metres, from where it has left the limb that it stands on, or from below its
/// seed, to its tip.
struct Limb {
  std::vector<TubeStation> line;  ///< at least two, or none: nothing to be seen
  std::vector<TubeFrame> frames;
  std::vector<double> arcs_m;  ///< of each station, along the line
  std::vector<double> params;  ///< of each station, on the stem's curve; -1 below a seed
  int sides = 0;
  double off_m = 0.0;      ///< so far from what it stands for may the line be
  std::uint8_t order = 0;  ///< of branching, as StemCurve's
  std::int32_t host = -1;  ///< the limb that it stands on; -1 for one that grew from a seed
  Foot foot;               ///< where there is a host

  double length_m() const { return arcs_m.back(); }
};

/// A cross-section of a limb, between its stations too.
struct Section {
  sim::Vec3 centre_m{0.0};
  double radius_m = 0.0;
  TubeFrame frame;
  float exposure = 0.0f, youth = 0.0f;

  /// The unit way out at an angle, radians.
  sim::Vec3 out(double angle) const;
  sim::Vec3 surface(double angle) const { return centre_m + radius_m * out(angle); }
};
Section sectionAt(const Limb& limb, double arc_m);
/// A station between two.
TubeStation mixed(const TubeStation& a, const TubeStation& b, double share);
/// A cross-section without its axes.
TubeStation stationOn(const Limb& limb, double arc_m);

/// The point of a limb's line next to another, from a stretch between two stations downhill.
struct NearLine {
  std::size_t stretch = 0;
  double share = 0.0;  ///< of the stretch
  sim::Vec3 centre_m{0.0};
  double distance_m = 0.0, radius_m = 0.0;
};
NearLine nearestOn(const Limb& limb, std::size_t stretch, sim::Vec3 p_m);
double arcOf(const Limb& limb, const NearLine& place);

/// The stretch to which a parameter of the stem's curve belongs; the first or the last beyond them.
std::size_t stretchAt(const Limb& limb, double param);

/// Sides of a ring: its circle is hardly more than `error_m` away from them, or a twenty-fifth of its radius.
/// Five at least, or three of what hardly shows.
int sidesFor(double radius_m, double error_m);

}  // namespace espalier::render
