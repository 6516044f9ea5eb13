#include "render/files/gltf_instances.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "render/files/gltf_surfaces.h"
#include "sim/base/hasher.h"

namespace espalier::render {
namespace {

using Shorts4 = std::array<std::int16_t, 4>;

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

std::uint64_t hashOfPlaces(const ModelMesh& shape) {
  sim::Hasher hash;
  for (const sim::Vec3f p : shape.positions_m) {
    for (const float x : {p.x, p.y, p.z}) hash.add(x);
  }
  return hash.digest();
}

Shorts4 shortsOf(const glm::quat& turn) {
  const auto shortOf = [](float share) { return static_cast<std::int16_t>(std::lround(share * 32767.0f)); };
  return {shortOf(turn.x), shortOf(turn.y), shortOf(turn.z), shortOf(turn.w)};
}

/// One value of each place.
template <class T, class Value>
std::vector<T> ofEach(const std::vector<Placement>& places, Value value) {
  std::vector<T> all;
  all.reserve(places.size());
  for (const Placement& place : places) all.push_back(static_cast<T>(value(place)));
  return all;
}

}  // namespace

int GltfInstances::node(const Instances& instances, const std::string& kind, std::int32_t last_birth) {
  const PlantSurface surface = instances.stalks ? PlantSurface::stalks : PlantSurface::blades;
  const int material = plantMaterial(materials_, instances.shape, kind, surface, 1.0f);
  const auto [mesh, is_new] = shapes_.try_emplace({hashOfPlaces(instances.shape), kind, material}, 0);
  if (is_new) {
    const Needed needed = neededOf(instances.shape, surface);
    std::vector<tinygltf::Primitive> primitives;
    forEachPart(instances.shape, needed, [&](const MeshPart& part) {
      primitives.push_back(shapeOf(file_, instances.shape, needed, part, surface));
      primitives.back().material = material;
    });
    mesh->second = addMesh(file_, kind, std::move(primitives));
  }
  const int node = file_.node(instances.shape.name, mesh->second);

  const auto& places = instances.places;
  constexpr int kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT, kByte = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
  tinygltf::Value::Object attributes;
  const auto add = [&](const char* name, const auto& values, int component, int type, bool normalized) {
    attributes[name] = tinygltf::Value(file_.instances(std::span(values), component, type, normalized));
  };
  add("TRANSLATION", ofEach<sim::Vec3f>(places, [](const Placement& p) { return p.position_m; }), kFloat,
      TINYGLTF_TYPE_VEC3, false);
  add("ROTATION", ofEach<Shorts4>(places, [](const Placement& p) { return shortsOf(p.turn); }),
      TINYGLTF_COMPONENT_TYPE_SHORT, TINYGLTF_TYPE_VEC4, true);
  add("SCALE", ofEach<sim::Vec3f>(places, [](const Placement& p) { return p.scale; }), kFloat,
      TINYGLTF_TYPE_VEC3, false);
  add("_EXPOSURE", ofEach<std::uint8_t>(places, [](const Placement& p) { return byteOf(p.exposure); }), kByte,
      TINYGLTF_TYPE_SCALAR, true);
  add("_AGE", ofEach<std::uint8_t>(places, [](const Placement& p) { return byteOf(p.youth); }), kByte,
      TINYGLTF_TYPE_SCALAR, true);
  const auto birth = [&](const Placement& p) { return birthOf(p.youth, last_birth); };
  if (last_birth <= std::numeric_limits<std::uint16_t>::max()) {
    add("_BIRTH", ofEach<std::uint16_t>(places, birth), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
        TINYGLTF_TYPE_SCALAR, false);
  } else {
    add("_BIRTH", ofEach<float>(places, birth), kFloat, TINYGLTF_TYPE_SCALAR, false);
  }
  add("_ORDER", ofEach<std::uint8_t>(places, [](const Placement& p) { return p.order; }), kByte,
      TINYGLTF_TYPE_SCALAR, false);
  if (instances.tinted) {
    // As they are: a program that does not know them shows the material's own colour.
    add("_TINT", ofEach<sim::Colour>(places, [](const Placement& p) { return p.tint; }), kFloat,
        TINYGLTF_TYPE_VEC3, false);
  }
  tinygltf::Value::Object extension{{"attributes", tinygltf::Value(std::move(attributes))}};
  file_.model().nodes[static_cast<std::size_t>(node)].extensions[kInstancing] =
      tinygltf::Value(std::move(extension));
  file_.require(kInstancing);
  return node;
}

}  // namespace espalier::render
