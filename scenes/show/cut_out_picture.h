#pragma once
#include "render/image/image.h"
#include "scenes/show/pictures.h"

namespace espalier::scenes {

/// A mesh of the scene seen straight on: along the mean of its triangles' normals, with the world's y
/// upwards, or its -z where the mesh lies level. The limbs that lie in it are drawn, as thick as they are.
/// RGBA. Throws InputError for a mesh that is not there or has no area from that side.
render::Image drawCutOut(const Finished& finished, const ImageSpec& image, glm::ivec2 most_px);

/// Throws PlacedError where a scene's cut-outs have no mesh that is seen straight on.
void requireCutOutsSeen(const Scene& scene, const std::vector<sim::TiledMesh>& meshes);

}  // namespace espalier::scenes
