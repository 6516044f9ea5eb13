#pragma once
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "sim/base/vec.h"
#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// What a mesh's outer form tells of how it is meant. Lengths are in metres, or in units of a file where its
/// numbers stand for themselves.
struct MeshShape {
  sim::Vec3 low{INFINITY}, high{-INFINITY};  ///< of the corners of its triangles
  double area = 0.0;
  std::array<double, 3> across{};  ///< shares of the area that look along x, y and z, to 10 degrees
  std::array<double, 3> beside{};  ///< shares that stand along x, y and z, likewise: walls, for y
  std::array<double, 3> level{};   ///< shares that look rather along x, y and z than across: to 45 degrees
  sim::Vec3 middle{0.0};           ///< of the area
  sim::Vec3 net{0.0};              ///< mean normal by area: of a closed surface none

  sim::Vec3 size() const { return high - low; }
  double longest() const;
};

MeshShape shapeOf(const sim::Mesh& mesh);

/// Lengths between which areas are numbers, and not 0.
inline constexpr double kLeastLength = 1e-9, kMostLength = 1e12;
bool isOfALength(const MeshShape& shape);

double areaOf(const sim::Mesh& mesh, std::size_t triangle);

/// Nothing that plants grow on is longer than that, but for towns and terrain.
inline constexpr double kLarge_m = 200.0;
/// Something with walls that is as high as no house: kLarge_m. Terrain has no walls, and no town is so high.
bool isTooHighForAHouse(const MeshShape& shape_m, UpAxis up);

/// A unit that a mesh's numbers may be in, and how large it then is.
struct UnitReading {
  LengthUnit unit = LengthUnit::m;
  double longest_m = 0.0;
};

/// The units, of m, cm and mm, in which something so long is between 1 and 100 m, as what plants climb is:
/// the one that comes nearest to 10 m first. `longest`: in the file's own numbers.
std::vector<UnitReading> likelyUnits(double longest);

/// "8.78", "1900": three digits, or all of a whole number.
std::string inDigits(double number);
/// "8.8 x 6.1 x 5.8 m".
std::string sizeText(const sim::Vec3& size_m);

}  // namespace espalier::scenes
