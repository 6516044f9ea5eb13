#include "render/files/obj.h"

#include <ostream>
#include <string>
#include <vector>

#include "render/files/obj_materials.h"
#include "render/files/obj_writer.h"
#include "render/files/surfaces.h"
#include "sim/base/stop.h"

namespace espalier::render {
namespace {

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
  library.mtl = objFirstLine(made_by) + library.mtl;
  return library;
}

void writeObj(std::ostream& file, const std::vector<const sim::Mesh*>& meshes, const PlantModels& plants,
              const std::string& stem, const sim::Provenance& made_by) {
  ObjMaterials materials(stem, false);
  file << objFirstLine(made_by) << "mtllib " << stem << ".mtl\n";
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
