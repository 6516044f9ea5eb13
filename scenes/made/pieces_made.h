#pragma once
#include <string>
#include <vector>

#include "scenes/prepare/site.h"
#include "scenes/problem.h"
#include "scenes/scene.h"
#include "sim/cut/pieces.h"
#include "sim/grow/grow.h"

namespace espalier::scenes {

/// A mesh of a scene, cut into pieces.
struct PiecesMade {
  std::string name, of;
  double kerf_m = 0.0, voxel_m = 0.0;
  sim::Pieces cut;  ///< meshes, and the only region of each, are called NAME_1, NAME_2 ..
};

/// Throws PlacedError for what cannot be cut, whatever grows: see sim::requireCuttable.
void requirePiecesSound(const Scene& scene, const Site& site);

/// Cuts the scene's meshes as it asks for along what has grown on its site. `warnings` takes, each with its
/// place: that a mesh stays in one piece. Throws PlacedError.
std::vector<PiecesMade> makePieces(const Scene& scene, const Site& site, const sim::Growth& growth,
                                   std::vector<Problem>& warnings);

}  // namespace espalier::scenes
