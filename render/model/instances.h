#pragma once
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "render/model/leaf_feet.h"
#include "render/model/model_mesh.h"
#include "sim/base/frame.h"
#include "sim/grow/plant.h"

namespace espalier::render {

/// Where a shape stands: scaled, turned, moved.
struct Placement {
  sim::Vec3f position_m{0.0f};
  glm::quat turn{1.0f, 0.0f, 0.0f, 0.0f};
  sim::Vec3f scale{1.0f};
  float exposure = 0.0f, youth = 0.0f;
  std::uint8_t order = 0;
  sim::Colour tint{1.0f};
};

/// One shape, and the places where it stands.
struct Instances {
  ModelMesh shape;      ///< in its own frame, in metres at scale 1; its name is that of all of them
  bool stalks = false;  ///< else blades
  bool tinted = false;
  std::vector<Placement> places;
};

/// A plant's blades of one shape, out of the mesh in which each is drawn by itself, for what is said there of
/// each. `shape`: its number.
Instances bladesAsInstances(const ModelMesh& blades, const sim::Plant& plant, const LeafFeet& feet,
                            std::size_t shape, const sim::Frame& frame);

/// Stalks, each of which appendTube made of two stations with so many sides, as scaled ones of length and
/// radius 1 along +y.
Instances stalksAsInstances(const ModelMesh& stalks, int sides);

}  // namespace espalier::render
