#include "render/files/diced_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "render/files/gltf_surfaces.h"
#include "render/files/obj_writer.h"
#include "render/image/tone.h"
#include "sim/base/stop.h"

namespace espalier::render {
namespace {

constexpr const char* kUnlit = "KHR_materials_unlit";

using Colour16 = std::array<std::uint16_t, 4>;

Colour16 colour16Of(sim::Colour colour) {
  constexpr float kWhole = 65535.0f;
  Colour16 colour16{};
  for (int i = 0; i < 3; ++i) {
    colour16[static_cast<std::size_t>(i)] =
        static_cast<std::uint16_t>(std::lround(std::clamp(colour[i], 0.0f, 1.0f) * kWhole));
  }
  colour16[3] = static_cast<std::uint16_t>(kWhole);
  return colour16;
}

void addMaterial(GlbFile& file, DicedLight light) {
  tinygltf::Material material;
  material.name = "voxel colours";
  material.doubleSided = true;
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  material.pbrMetallicRoughness.roughnessFactor = 1.0;
  if (light == DicedLight::given) {
    material.extensions[kUnlit] = tinygltf::Value(tinygltf::Value::Object());
    file.use(kUnlit);
  }
  file.model().materials.push_back(std::move(material));
}

void addDiced(GlbFile& file, const DicedMesh& diced) {
  std::vector<Colour16> colours;
  colours.reserve(diced.colours.size());
  for (const sim::Colour colour : diced.colours) colours.push_back(colour16Of(colour));
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = 0;
  primitive.attributes["POSITION"] = file.positions(diced.positions_m);
  primitive.attributes["COLOR_0"] =
      file.vertices<Colour16>(colours, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4, true);
  primitive.indices = file.indices(diced.triangles, diced.positions_m.size());
  file.model().scenes[0].nodes.push_back(
      file.node(diced.name, addMesh(file, diced.name, {std::move(primitive)})));
}

}  // namespace

void writeDicedGlb(std::iostream& file, const DicedMeshes& meshes, DicedLight light,
                   const sim::Provenance& made_by) {
  writeGlbFile(file, made_by, [&](GlbFile& writer) {
    addMaterial(writer, light);
    meshes([&](const DicedMesh& mesh) {
      sim::throwIfStopped();
      if (!mesh.empty()) addDiced(writer, mesh);
    });
  });
}

void writeDicedObj(std::ostream& file, const DicedMeshes& meshes, const sim::Provenance& made_by) {
  file << objFirstLine(made_by);
  ObjWriter writer(file);
  std::vector<sim::Colour> shown;
  meshes([&](const DicedMesh& mesh) {
    sim::throwIfStopped();
    if (mesh.empty()) return;
    shown.clear();
    for (const sim::Colour colour : mesh.colours) shown.push_back(srgbFromLinear(colour));
    writer.begin("o", mesh.name);
    writer.add(mesh.positions_m, shown, mesh.triangles);
  });
  writer.finish();
}

}  // namespace espalier::render
