#include "scenes/job/pieces_shown.h"

#include <algorithm>
#include <cmath>

#include "scenes/prepare/in_scene.h"
#include "sim/light/lighting.h"
#include "sim/tile/build_world.h"

namespace espalier::scenes {
namespace {

/// Moves pieces away from their middle, and all of them up by so much that none is lower than before.
std::vector<sim::Mesh> movedApart(const sim::Pieces& cut, double apart) {
  std::vector<sim::Mesh> meshes;
  double lowest = INFINITY, lowest_before = INFINITY;
  for (const sim::Piece& piece : cut.pieces) {
    sim::Mesh mesh = piece.mesh;
    for (sim::Vec3& p : mesh.vertices_m) {
      lowest_before = std::min(lowest_before, p.y);
      p += apart * (piece.middle_m - cut.middle_m);
      lowest = std::min(lowest, p.y);
    }
    meshes.push_back(std::move(mesh));
  }
  for (sim::Mesh& mesh : meshes)
    for (sim::Vec3& p : mesh.vertices_m) p.y += lowest_before - lowest;
  return meshes;
}

/// The site's frame, and as many voxels more as the meshes want, with free ones around.
sim::Frame frameFor(const sim::Frame& site, const std::vector<sim::Mesh>& meshes) {
  constexpr int kRim = 4;
  sim::Voxel low(0), high = site.size - 1;
  for (const sim::Mesh& mesh : meshes) {
    for (const sim::Vec3& p_m : mesh.vertices_m) {
      const sim::Vec3 p = sim::voxelFromWorld(site, p_m);
      low = glm::min(low, sim::Voxel(glm::floor(p)) - kRim);
      high = glm::max(high, sim::Voxel(glm::ceil(p)) + kRim);
    }
  }
  low.y = 0;  // nothing is lower than before
  return {sim::worldFromVoxel(site, sim::Vec3(low)), site.voxel_m, high - low + 1};
}

ShownPieces shownAt(double apart, const Site& site, const std::vector<PiecesMade>& made) {
  ShownPieces shown;
  shown.apart = apart;
  for (const PiecesMade& one : made) {
    shown.instead_of.insert(one.of);
    for (sim::Mesh& mesh : movedApart(one.cut, apart)) shown.meshes.push_back(std::move(mesh));
  }
  shown.frame = frameFor(site.world.frame(), shown.meshes);
  sim::requireFits(shown.frame, {0, 4.0});  // numbers of 16 bits, and what finds them
  std::vector<sim::TiledMesh> stand;
  for (const sim::TiledMesh& tiled : site.meshes)
    if (!shown.instead_of.contains(tiled.mesh.name)) stand.push_back(tiled);
  for (const sim::Mesh& mesh : shown.meshes) {
    sim::TiledMesh& piece = stand.emplace_back();
    piece.mesh = mesh;
    piece.solid = true;
  }
  const sim::World world = sim::buildWorld(shown.frame, stand, 0);
  sim::LightWanted wanted;
  wanted.faces = false;
  wanted.dense = true;
  shown.sky = sim::lightOf(world, site.sky, {}, wanted).space_sky;
  shown.occupied = world.occupied();
  return shown;
}

}  // namespace

bool showsPieces(const ImageSpec& image) {
  return image.kind == ImageKind::vines &&
         std::find(image.show.begin(), image.show.end(), "pieces") != image.show.end();
}

std::vector<ShownPieces> shownPieces(const Scene& scene, const Site& site,
                                     const std::vector<PiecesMade>& made,
                                     const std::vector<ImageSpec>& images) {
  std::vector<ShownPieces> all;
  for (const ImageSpec& image : images) {
    if (!showsPieces(image) ||
        std::any_of(all.begin(), all.end(), [&](const ShownPieces& one) { return one.apart == image.apart; }))
      continue;
    all.push_back(inScene(scene, scene.images_place, [&] { return shownAt(image.apart, site, made); }));
  }
  return all;
}

}  // namespace espalier::scenes
