#include "scenes/show/vines_picture.h"

#include <algorithm>

#include "render/finish/finished_picture.h"
#include "render/image/bloom.h"
#include "scenes/show/model_parts.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

bool shows(const ImageSpec& image, const char* part) {
  return std::find(image.show.begin(), image.show.end(), part) != image.show.end();
}

/// As the image shows them; null where it does not.
const ShownPieces* piecesFor(const ImageSpec& image, const Finished& finished) {
  if (finished.pieces == nullptr || !shows(image, "pieces")) return nullptr;
  for (const ShownPieces& pieces : *finished.pieces)
    if (pieces.apart == image.apart) return &pieces;
  return nullptr;
}

/// Heights of a name, or the first, in the light of their own world.
void showHeights(render::FinishedScene& scene, std::span<const MadeHeights> all, const std::string& name) {
  const auto one = std::find_if(all.begin(), all.end(),
                                [&](const MadeHeights& made) { return name.empty() || made.name == name; });
  if (one == all.end() || one->world == nullptr)
    throw sim::InputError("an image shows heights that were not made; expected a run that grows them");
  for (const sim::Mesh& mesh : one->meshes) {
    scene.model.meshes.push_back(&mesh);
    scene.pictures[mesh.materials[0].texture.get()] = one->picture;
  }
  scene.frame = one->world->frame();
  scene.occupied = &one->world->occupied();
  scene.sky = one->sky.get();
  scene.bounced = {};
}

}  // namespace

bool drawsVines(const std::vector<ImageSpec>& images) {
  return std::any_of(images.begin(), images.end(),
                     [](const ImageSpec& image) { return image.kind == ImageKind::vines; });
}

bool showsNoPlant(const ImageSpec& image) {
  return image.kind == ImageKind::vines && !shows(image, "stems") && !shows(image, "elements") &&
         !shows(image, "pieces") && !shows(image, "heights");
}

render::Image vinesPicture(const ImageSpec& image, const Finished& finished, const VinesLook& look,
                           const render::Camera& camera, glm::ivec2 size_px) {
  render::FinishedScene scene;
  const ShownPieces* const pieces = piecesFor(image, finished);
  for (const auto& tiled : finished.meshes) {
    if (pieces != nullptr && pieces->instead_of.contains(tiled.mesh.name)) continue;
    if (shows(image, tiled.guide ? "guides" : "scene")) scene.model.meshes.push_back(&tiled.mesh);
  }
  if (pieces != nullptr)
    for (const sim::Mesh& mesh : pieces->meshes) scene.model.meshes.push_back(&mesh);
  const bool stems = shows(image, "stems"), elements = shows(image, "elements");
  const bool all = stems && elements;
  const std::vector<render::PlantModel> parts =
      all ? std::vector<render::PlantModel>() : partsOf(finished.models, stems, elements);
  for (const auto& model : all ? finished.models : parts) scene.model.plants.push_back(&model);
  scene.pictures = finished.textures;
  scene.frame = finished.world.frame();
  const bool bare = showsNoPlant(image);
  scene.occupied = bare ? &finished.bare : &finished.world.occupied();
  scene.sky = (bare ? finished.light.bare_sky : finished.light.space_sky).get();
  if (!bare) scene.bounced = bouncedIn(finished.lit, scene.frame);
  if (pieces != nullptr) {  // in a world of their own
    scene.frame = pieces->frame;
    scene.occupied = &pieces->occupied;
    scene.sky = pieces->sky.get();
    scene.bounced = {};
  }
  if (shows(image, "heights")) showHeights(scene, finished.heights, image.heights);
  scene.to_sun = look.to_sun;
  scene.daylight = look.daylight;
  render::Image picture = render::finishedPicture(scene, camera, size_px.x, size_px.y);
  render::bloom(picture, look.bloom);
  return picture;
}

}  // namespace espalier::scenes
