#include "render/files/obj.h"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "render/files/obj_materials.h"
#include "render/files/surfaces.h"
#include "sim/base/stop.h"

namespace espalier::render {
namespace {

std::string firstLine(const sim::Provenance& made_by) {
  std::string text = fmt::format("# {}", made_by.software.empty() ? "Espalier" : made_by.software);
  if (!made_by.software.empty()) text += fmt::format(", seed {}", made_by.seed);
  for (char& c : text) c = c == '\n' || c == '\r' ? ' ' : c;
  return text + "\n";
}

/// Writes surfaces one after the other; OBJ numbers corners through the whole file.
class ObjWriter {
 public:
  explicit ObjWriter(std::ostream& file) : file_(file) {}

  void begin(const char* keyword, const std::string& name) { put("{} {}\n", keyword, objName(name)); }
  /// Uvs and normals: of each vertex, or empty.
  template <class Positions>
  void add(const std::string& material, const Positions& positions, std::span<const glm::vec2> uvs,
           std::span<const sim::Vec3f> normals, std::span<const std::array<std::uint32_t, 3>> triangles) {
    for (const auto& p : positions) put("v {} {} {}\n", p.x, p.y, p.z);
    for (const glm::vec2 uv : uvs) put("vt {:.5g} {:.5g}\n", uv.x, uv.y);
    for (const sim::Vec3f n : normals) put("vn {:.4g} {:.4g} {:.4g}\n", n.x, n.y, n.z);
    put("usemtl {}\n", material);
    for (const auto& triangle : triangles) {
      text_ += 'f';
      for (const std::uint32_t corner : triangle) {
        fmt::format_to(std::back_inserter(text_), " {}", vertices_ + corner);
        if (!uvs.empty() || !normals.empty()) text_ += '/';
        if (!uvs.empty()) fmt::format_to(std::back_inserter(text_), "{}", uvs_ + corner);
        if (!normals.empty()) fmt::format_to(std::back_inserter(text_), "/{}", normals_ + corner);
      }
      put("\n");
    }
    vertices_ += std::size(positions);
    uvs_ += uvs.size();
    normals_ += normals.size();
  }
  void finish() {
    file_ << text_;
    text_.clear();
  }

 private:
  template <class... Values>
  void put(fmt::format_string<const Values&...> format, const Values&... values) {
    fmt::format_to(std::back_inserter(text_), format, values...);
    constexpr std::size_t kAtOnce = 1 << 16;
    if (text_.size() > kAtOnce) finish();
  }

  std::ostream& file_;
  std::string text_;
  std::size_t vertices_ = 1, uvs_ = 1, normals_ = 1;
};

void writeMesh(ObjWriter& writer, ObjMaterials& materials, const sim::Mesh& mesh) {
  const std::vector<MaterialSurface> surfaces = surfacesOf(mesh);
  if (!surfaces.empty()) writer.begin("o", mesh.name);
  for (const MaterialSurface& surface : surfaces) {
    writer.add(materials.nameOf(mesh.materials[surface.material]), surface.positions_m, surface.uvs,
               surface.normals, surface.triangles);
  }
}

void writePlant(ObjWriter& writer, ObjMaterials& materials, const PlantModel& plant) {
  writer.begin("o", plant.name);
  forEachSurface(plant, [&](const ModelMesh& mesh, const std::string& kind, PlantSurface) {
    writer.begin("g", mesh.name);
    writer.add(materials.nameOf(kind, mesh), mesh.positions_m, mesh.uvs, mesh.normals, mesh.triangles);
  });
}

}  // namespace

ObjLibrary objLibrary(const std::vector<const sim::Mesh*>& meshes, const PlantModels& plants,
                      const std::string& stem, const sim::Provenance& made_by) {
  ObjMaterials materials(stem, true);
  for (const sim::Mesh* mesh : meshes) {
    for (const MaterialSurface& surface : surfacesOf(*mesh))
      materials.nameOf(mesh->materials[surface.material]);
  }
  plants([&](const PlantModel& plant) {
    sim::throwIfStopped();
    forEachSurface(plant, [&](const ModelMesh& mesh, const std::string& kind, PlantSurface) {
      materials.nameOf(kind, mesh);
    });
  });
  ObjLibrary library = materials.take();
  library.mtl = firstLine(made_by) + library.mtl;
  return library;
}

void writeObj(std::ostream& file, const std::vector<const sim::Mesh*>& meshes, const PlantModels& plants,
              const std::string& stem, const sim::Provenance& made_by) {
  ObjMaterials materials(stem, false);
  file << firstLine(made_by) << "mtllib " << stem << ".mtl\n";
  ObjWriter writer(file);
  for (const sim::Mesh* mesh : meshes) {
    sim::throwIfStopped();
    writeMesh(writer, materials, *mesh);
  }
  plants([&](const PlantModel& plant) {
    sim::throwIfStopped();
    writePlant(writer, materials, plant);
  });
  writer.finish();
}

}  // namespace espalier::render
