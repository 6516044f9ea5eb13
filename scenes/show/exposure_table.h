#pragma once
#include <array>
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "sim/light/lighting.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// How one quantity is spread over an area. Everything is weighted by area: a voxel that a surface only
/// touches counts little.
struct Spread {
  static constexpr std::size_t kBins = 20;

  double mean = 0.0, deviation = 0.0;  ///< standard deviation
  double least = 0.0, lower_quartile = 0.0, median = 0.0, upper_quartile = 0.0, greatest = 0.0;
  std::array<double, kBins>
      histogram{};  ///< shares of the area by equal steps from 0 to the quantity's range
};

struct ExposureRow {
  std::string object, region;  ///< both empty: all surfaces
  std::string faces;           ///< the way, as wayOf names it; empty: all ways
  std::size_t voxels = 0;
  double area_m2 = 0.0;         ///< coverage times a voxel's face, summed
  double left_out_m2 = 0.0;     ///< of more that was left out (Unreached)
  std::vector<Spread> spreads;  ///< by ExposureTable::quantities
};

/// Statistics of the exposure of a world's surfaces, by region.
struct ExposureTable {
  struct Quantity {
    std::string name, unit, meaning;
    double range = 1.0;  ///< from 0 to this
  };
  std::string scene;
  sim::LightAbout about;
  std::vector<Quantity> quantities;  ///< those of a sun only where there is one
  std::vector<ExposureRow> rows;  ///< regions that have surfaces, then the total, each first as a whole and
                                  ///< then by the ways that its surfaces face
  Unreached unreached = Unreached::count;
  std::size_t left_out = 0;  ///< surface voxels
  double left_out_m2 = 0.0;  ///< their area, also of regions that have no row for it
};

/// Where a surface with this unit normal faces: "up" and "down" for what leans to the level by less than 30
/// degrees, else the nearest of "N", "NE" .. "NW". `north_deg` is the model's compass way of true north.
std::string wayOf(sim::Vec3f normal, double north_deg);

/// `scene` is its name. `light` has the brightest ways where surfaces are left out.
ExposureTable exposureTable(const std::string& scene, const sim::World& world, const sim::Lighting& light,
                            double north_deg = 0.0, Unreached unreached = Unreached::count);

/// A row for each region and quantity, RFC 4180, with a header that names units; exposures to 4 decimals.
std::string toCsv(const ExposureTable& table);
/// The same numbers.
std::string toJson(const ExposureTable& table);
/// Means by region, and of all by where they face, as a text to read: of more than 40 regions the largest.
std::string toText(const ExposureTable& table);

}  // namespace espalier::scenes
