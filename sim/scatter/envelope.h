#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <variant>
#include <vector>

#include "sim/base/vec.h"
#include "sim/scatter/point_set.h"

/// Upright solids, such as the crowns of trees, and points strewn in them.
namespace espalier::sim {

/// Tapers from its foot to a point.
struct Cone {
  double height = 0.0, radius = 0.0;
};
/// The crown of the same name of D. Sforza's tree-gen: as high as its radius, with the Bezier radii R, R,
/// R/2, R/6 at even heights; flat above and below.
struct Dome {
  double radius = 0.0;
};
struct Cylinder {
  double height = 0.0, radius = 0.0;
};
struct Sphere {
  double radius = 0.0;
};
struct Ellipsoid {
  Vec3 radii{0.0};  ///< along x, y, z
};
struct Box {
  Vec3 size{0.0};  ///< along x, y, z
};
/// A surface of revolution about the y axis: a cubic Bezier curve by its control points [height, radius].
struct Revolution {
  std::array<glm::dvec2, 4> profile{};  ///< heights above the foot, which must not fall; radii not negative
};

using Solid = std::variant<Cone, Dome, Cylinder, Sphere, Ellipsoid, Box, Revolution>;

/// A solid in its place.
struct Envelope {
  Solid solid;
  Vec3 foot{0.0};  ///< the lowest point on its axis: a sphere's south pole, the middle of a box's floor
};

struct EnvelopeBounds {
  Vec3 low, high;
};

/// Throws InputError for sizes that are negative or no numbers, for one that is empty, for a profile whose
/// heights fall.
void requireSound(const Envelope& envelope);

// Of a sound envelope.
bool contains(const Envelope& envelope, Vec3 point);
EnvelopeBounds boundsOf(const Envelope& envelope);
double volumeOf(const Envelope& envelope);

/// What points are spread evenly by. By height: every layer has as many, and in it they lie evenly, as the
/// crowns of tree-gen have them; so a thin layer is dense.
enum class Spread { volume, height };

/// One point of a curve along an envelope's height.
struct DensityAt {
  double share = 0.0;  ///< of the height, 0 at the lowest point, 1 at the highest
  double density = 0.0;
};

/// How points are strewn in an envelope.
struct Strewing {
  std::size_t count = 0;
  Spread spread = Spread::volume;
  std::vector<DensityAt> density;  ///< by share, rising; linear between, level beyond the ends; none: even
};

/// Throws InputError for no points, more than 2^32 - 1, and a density that is negative, no number, out of
/// order or nothing anywhere.
void requireSound(const Strewing& strewing);

/// Points in an envelope: each follows from the stream and its number alone, so that more of them begin with
/// the same ones. Throws InputError as requireSound.
PointSet scatterInside(const Envelope& envelope, const Strewing& strewing, std::uint64_t stream);

}  // namespace espalier::sim
