#pragma once
#include <map>
#include <memory>
#include <vector>

#include "scenes/problem.h"
#include "scenes/scene.h"
#include "sim/base/picture.h"
#include "sim/tile/build_world.h"

namespace espalier::scenes {

/// Textures of scene meshes, to be drawn.
struct ReadTextures {
  std::map<const sim::Texture*, std::shared_ptr<const sim::Picture>> pictures;
  std::vector<Problem> unread;  ///< each that could not be read, with the place of its mesh
};

/// Of all materials of a scene's meshes that have UVs, each in a child process
/// (scenes/import/guarded_file.h), as PNG or JPEG by what they say they are, with the bounds of readPicture.
ReadTextures readTextures(const Scene& scene, const std::vector<sim::TiledMesh>& meshes);

}  // namespace espalier::scenes
