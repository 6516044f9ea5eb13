#pragma once
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "sim/base/bits.h"
#include "sim/base/frame.h"
#include "sim/tile/mesh.h"
#include "sim/world/field.h"

namespace espalier::scenes {

/// Pieces of a scene's meshes as an image of vines shows them: moved apart by so much, in a world of their
/// own with all that stands in the scene beside them, and what of the sky is seen there.
struct ShownPieces {
  double apart = 0.0;  ///< ImageSpec::apart
  std::vector<sim::Mesh> meshes;
  std::set<std::string> instead_of;  ///< the meshes that they are pieces of
  sim::Frame frame;
  sim::BitVolume occupied;
  std::shared_ptr<const sim::ExposureField> sky;
};

}  // namespace espalier::scenes
