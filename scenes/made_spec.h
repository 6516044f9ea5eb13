#pragma once
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/problem.h"
#include "sim/base/vec.h"
#include "sim/cut/pieces.h"
#include "sim/relief/meander.h"
#include "sim/relief/relief.h"

/// What a scene asks to be made of what has grown.
namespace espalier::scenes {

/// A mesh that is cut into pieces along what has grown.
struct PiecesSpec {
  std::string name;
  std::string of;               ///< the mesh
  std::vector<std::string> by;  ///< the plants whose limbs cut it
  double kerf_m = 0.02;         ///< width of the gap
  sim::Vec3 sweep_m{0.0};       ///< see sim::CutSettings
  std::optional<double> voxel_m;
  double least_share = 0.001;
  std::optional<sim::CutRoughness> rough;
  std::optional<sim::Colour> inside;  ///< linear RGB; without it, the colour of most of the mesh
  Place place = {};                   ///< where a scene file has it; without a path where none does
};

/// A layer of the colours of heights: over all that were named before it, wherever all that it says holds.
struct CoverSpec {
  std::string name;
  sim::Colour colour{0.5f};                ///< linear RGB
  std::optional<double> above_m, below_m;  ///< heights
  std::optional<double> steeper_deg, flatter_deg;
  double soft_m = 0.0;    ///< over so much of height it comes and goes
  bool on_lines = false;  ///< on the lines themselves, as wide as they are
};

/// Land that is made of what has grown, in plan.
struct HeightsSpec {
  std::string name;
  std::string plants;              ///< of which planting
  std::vector<glm::dvec2> over_m;  ///< x and z of two corners; none: the world's
  double spacing_m = 0.0;          ///< between samples; 0: a thousandth of the longer side
  sim::ReliefLaw law;
  sim::Meander meander;
  std::optional<int> iteration;  ///< of what stands after so many; without: at the end
  std::vector<CoverSpec> cover;
  Place place = {}, plants_place = {};  ///< where a scene file has it, and names its plants
};

}  // namespace espalier::scenes
