#include "scenes/prepare/texture_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "render/image/image_io.h"
#include "scenes/clean_text.h"
#include "scenes/import/guarded_file.h"
#include "scenes/import/picture_reader.h"
#include "sim/base/error.h"
#include "sim/base/stop.h"

namespace espalier::scenes {
namespace {

std::shared_ptr<const sim::Picture> readTexture(const sim::Texture& texture) {
  const std::string bytes = readInChild({"texture", {texture.mime_type, texture.bytes}},
                                        limitsFor(texture.bytes.size()), "texture");
  sim::InputFile unused;
  try {
    return std::make_shared<const sim::Picture>(pictureFromChild(bytes, unused));
  } catch (const std::runtime_error& error) {
    throw sim::InputError(fmt::format("it is damaged: it confused the picture reader ({})", error.what()));
  }
}

Place placeOfMesh(const Scene& scene, const std::string& name) {
  const auto at = std::find_if(scene.meshes.begin(), scene.meshes.end(),
                               [&](const SceneMesh& mesh) { return mesh.name == name; });
  return at == scene.meshes.end() ? Place{} : at->place;
}

}  // namespace

ReadTextures readTextures(const Scene& scene, const std::vector<sim::TiledMesh>& meshes) {
  ReadTextures read;
  std::set<const sim::Texture*> tried;
  for (const sim::TiledMesh& tiled : meshes) {
    const sim::Mesh& mesh = tiled.mesh;
    if (mesh.uvs.empty()) continue;
    for (const sim::Material& material : mesh.materials) {
      const sim::Texture* const texture = material.texture.get();
      if (texture == nullptr || !tried.insert(texture).second) continue;
      sim::throwIfStopped();
      render::makeReadyToDraw();  // a child would load it for itself, and say less of why it cannot
      try {
        read.pictures[texture] = readTexture(*texture);
      } catch (const sim::InputError& error) {
        read.unread.push_back(problemAt(
            placeOfMesh(scene, mesh.name), scene.file,
            fmt::format("mesh '{}': its texture '{}' is not drawn, but in its material's colour: {}",
                        cleanText(mesh.name), cleanText(texture->name), cleanText(error.what()))));
      }
    }
  }
  return read;
}

}  // namespace espalier::scenes
