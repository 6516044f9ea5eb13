#include "render/files/gltf_plant.h"

#include <algorithm>
#include <vector>

#include "render/files/gltf_compressed.h"
#include "render/files/gltf_surfaces.h"

namespace espalier::render {

int GltfPlants::surfaceNode(const ModelMesh& mesh, const std::string& material, PlantSurface kind,
                            double packed_m, std::int32_t last_birth) {
  const Needed needed = neededOf(mesh, kind);
  float scale = 1.0f;
  std::vector<Bytes4> tints;
  if (!mesh.tints.empty()) {
    float brightest = 0.0f;
    for (const sim::Colour tint : mesh.tints) brightest = std::max({brightest, tint.r, tint.g, tint.b});
    scale = tintScale(mesh, brightest);
    tints.reserve(mesh.tints.size());
    for (const sim::Colour tint : mesh.tints) tints.push_back(bytesOf(tint, scale));
  }
  std::vector<tinygltf::Primitive> primitives;
  forEachPart(mesh, needed, [&](const MeshPart& part) {
    if (packed_m > 0.0) {
      primitives.push_back(compressed(file_, mesh, needed, part, packed_m, last_birth, scale));
      return;
    }
    tinygltf::Primitive& primitive = primitives.emplace_back(shapeOf(file_, mesh, needed, part, kind));
    if (!tints.empty()) {
      primitive.attributes["COLOR_0"] = file_.vertices<Bytes4>(
          part.of(tints), TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC4, true);
    }
    primitive.attributes["_EXPOSURE"] = file_.numbers(part.of(mesh.exposures));
    primitive.attributes["_AGE"] = file_.numbers(part.of(mesh.youths));
    std::vector<float> births = part.of(mesh.youths);
    for (float& birth : births) birth = birthOf(birth, last_birth);
    primitive.attributes["_BIRTH"] = file_.numbers(births);
    primitive.attributes["_ORDER"] = file_.numbers(part.of<float>(mesh.orders));
  });
  const int number = plantMaterial(materials_, mesh, material, kind, scale);
  for (tinygltf::Primitive& primitive : primitives) primitive.material = number;
  return file_.node(mesh.name, addMesh(file_, mesh.name, std::move(primitives)));
}

void GltfPlants::add(const PlantModel& plant) {
  std::vector<int> children;
  forEachSurface(plant, [&](const ModelMesh& mesh, const std::string& kind, PlantSurface surface) {
    // Beside instances, which readers must know of anyway.
    const bool packed = surface == PlantSurface::stems && !plant.instances.empty();
    children.push_back(surfaceNode(mesh, kind, surface, packed ? plant.thinnest_m : 0.0, plant.last_birth));
  });
  for (const Instances& instances : plant.instances)
    children.push_back(instances_.node(instances, kindOf(plant, instances.shape), plant.last_birth));
  if (children.empty()) return;
  const int parent = file_.node(plant.name, -1);
  file_.model().nodes[static_cast<std::size_t>(parent)].children = std::move(children);
  file_.model().scenes[0].nodes.push_back(parent);
}

}  // namespace espalier::render
