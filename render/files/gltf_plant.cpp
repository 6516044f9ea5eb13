#include "render/files/gltf_plant.h"

#include <algorithm>
#include <vector>

#include "render/files/flat_mesh.h"
#include "render/files/gltf_surfaces.h"

namespace espalier::render {

int GltfPlants::surfaceNode(const ModelMesh& drawn, const std::string& material, PlantSurface kind) {
  const ModelMesh flat = kind == PlantSurface::blades ? withoutFlatNormals(drawn) : ModelMesh();
  const ModelMesh& mesh = flat.empty() ? drawn : flat;
  tinygltf::Primitive primitive = shapeOf(file_, mesh, kind);
  float scale = 1.0f;
  if (!mesh.tints.empty()) {
    float brightest = 0.0f;
    for (const sim::Colour tint : mesh.tints) brightest = std::max({brightest, tint.r, tint.g, tint.b});
    scale = tintScale(mesh, brightest);
    std::vector<Bytes4> tints;
    tints.reserve(mesh.tints.size());
    for (const sim::Colour tint : mesh.tints) tints.push_back(bytesOf(tint, scale));
    primitive.attributes["COLOR_0"] =
        file_.vertices<Bytes4>(tints, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC4, true);
  }
  const std::vector<float> orders(mesh.orders.begin(), mesh.orders.end());
  primitive.attributes["_EXPOSURE"] = file_.numbers(mesh.exposures);
  primitive.attributes["_AGE"] = file_.numbers(mesh.youths);
  primitive.attributes["_ORDER"] = file_.numbers(orders);
  primitive.material = plantMaterial(materials_, mesh, material, kind, scale);
  return file_.node(drawn.name, addMesh(file_, drawn.name, std::move(primitive)));
}

void GltfPlants::add(const PlantModel& plant) {
  std::vector<int> children;
  forEachSurface(plant, [&](const ModelMesh& mesh, const std::string& kind, PlantSurface surface) {
    children.push_back(surfaceNode(mesh, kind, surface));
  });
  for (const Instances& instances : plant.instances)
    children.push_back(instances_.node(instances, kindOf(plant, instances.shape)));
  if (children.empty()) return;
  const int parent = file_.node(plant.name, -1);
  file_.model().nodes[static_cast<std::size_t>(parent)].children = std::move(children);
  file_.model().scenes[0].nodes.push_back(parent);
}

}  // namespace espalier::render
