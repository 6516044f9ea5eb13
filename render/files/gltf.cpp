#include "render/files/gltf.h"

#include <fmt/format.h>

#include <initializer_list>
#include <limits>
#include <sstream>

#include "render/files/glb_words.h"
#include "render/files/gltf_plant.h"
#include "render/files/gltf_scene_mesh.h"
#include "sim/base/error.h"
#include "sim/base/stop.h"

namespace espalier::render {
namespace {

void putWords(std::ostream& out, std::initializer_list<std::size_t> words) {
  for (const std::size_t word : words) {
    for (unsigned byte = 0; byte < kGlbWord; ++byte) out.put(static_cast<char>(word >> (8 * byte) & 0xffu));
  }
}

}  // namespace

void writeGlb(std::ostream& file, const std::vector<const sim::Mesh*>& meshes, const PlantModels& plants,
              const sim::Provenance& made_by) {
  const auto addAll = [&](GlbFile& writer) {
    GltfMaterials materials(writer);
    GltfPlants grown(writer, materials);
    for (const sim::Mesh* mesh : meshes) {
      sim::throwIfStopped();
      addSceneMesh(writer, materials, *mesh);
    }
    plants([&](const PlantModel& plant) {
      sim::throwIfStopped();
      grown.add(plant);
    });
    writer.finish();
  };
  GlbFile measured(made_by, nullptr);
  addAll(measured);
  std::string json = measured.json();
  json.resize((json.size() + kGlbWord - 1) / kGlbWord * kGlbWord, ' ');
  const std::size_t buffer = measured.bufferBytes();
  const std::size_t all =
      kGlbHeader + kGlbChunkHeader + json.size() + (buffer > 0 ? kGlbChunkHeader + buffer : 0);
  if (all > std::numeric_limits<std::uint32_t>::max()) {
    throw sim::InputError(fmt::format("the plants' surfaces take {:.1f} GB; a .glb file holds at most 4",
                                      static_cast<double>(all) / 1e9));
  }
  putWords(file, {0x46546c67, 2, all, json.size(), 0x4e4f534a});  // "glTF", its version; "JSON"
  file << json;
  if (buffer == 0) return;
  putWords(file, {buffer, 0x004e4942});  // "BIN"
  GlbFile written(made_by, &file);
  addAll(written);
  if (written.bufferBytes() != buffer)
    throw sim::BrokenContract("a plant's model was another the second time");
}

std::string glbBytes(const ModelScene& scene, const sim::Provenance& made_by) {
  std::ostringstream out(std::ios::binary);
  const auto plants = [&](const std::function<void(const PlantModel&)>& take) {
    for (const PlantModel* plant : scene.plants) take(*plant);
  };
  writeGlb(out, scene.meshes, plants, made_by);
  return std::move(out).str();
}

}  // namespace espalier::render
