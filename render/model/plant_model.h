#pragma once
#include <cstdint>
#include <vector>

#include "render/model/instances.h"
#include "render/model/model_mesh.h"
#include "sim/base/bits.h"
#include "sim/base/frame.h"
#include "sim/grow/plant.h"

namespace espalier::render {

/// Levels of detail, each three times as coarse as the one before: how far surfaces of stems may be from what
/// they stand for, in radii of the thinnest twig.
inline constexpr int kLevels = 4;
constexpr double errorOfLevel(int level) {
  return level == 0 ? 0.4 : 3.0 * errorOfLevel(level - 1);
}

struct ModelOptions {
  /// How far rings of stems may be from what they stand for, in radii of the thinnest twig; their lines by
  /// one of these, or as much.
  double error = errorOfLevel(0);
  const sim::BitVolume* walls = nullptr;  ///< voxels that centre lines keep out of where the skeleton does
  bool instances = false;  ///< blades and stalks as instances of a shape each, in place of meshes
};

/// A plant's surfaces. Meshes may be empty: a lone seed has no stems.
struct PlantModel {
  std::string name;
  ModelMesh stems;
  double thinnest_m = 0.0;           ///< the least radius of its stems
  std::int32_t last_birth = 1;       ///< the iteration that a youth of 1 stands for
  std::size_t meeting_limbs = 0;     ///< pairs of limbs that run into each other where none leaves the other
  ModelMesh stalks;                  ///< from stems to blades that do not begin on them
  std::vector<ModelMesh> elements;   ///< one for each of the plant's shapes: blades
  std::vector<Instances> instances;  ///< in place of stalks and elements, where they are asked for
};

/// How many triangles it is drawn of, each instance's included.
std::size_t triangleCount(const PlantModel& model);

/// Models a plant: every stem a tube swept along a C2 curve through its nodes, thick as the pipe model says,
/// all of a seed's stems one closed surface (stem_surface.h); every element's polygons, with a stalk from the
/// stem to a blade that does not begin on it. Throws InputError as stemRadii does.
PlantModel modelPlant(const sim::Plant& plant, const sim::Frame& frame, const ModelOptions& options = {});

}  // namespace espalier::render
