#include "scenes/import/gltf_check.h"

#include <algorithm>
#include <array>
#include <initializer_list>

#include "scenes/import/assimp_scene.h"
#include "scenes/import/gltf_accessors.h"
#include "scenes/import/gltf_looks.h"
#include "scenes/import/gltf_nodes.h"
#include "scenes/import/gltf_vertices.h"
#include "scenes/problem.h"

namespace espalier::scenes::gltf {
namespace {

constexpr const char *kDraco = "KHR_draco_mesh_compression", *kQuantized = "KHR_mesh_quantization";

/// The members that are read, where they are there.
Json only(const Json& object, std::initializer_list<const char*> keys) {
  Json some = Json::object();
  for (const char* key : keys) {
    const auto member = object.find(key);
    if (member != object.end()) some[key] = *member;
  }
  return some;
}

void keepName(const Json& from, Json& to) {
  const auto name = from.find("name");
  if (name != from.end() && name->is_string()) to["name"] = *name;
}

/// What a file says that it cannot be read without. Most such extensions are about looks.
void requireReadable(const Json& document) {
  static constexpr std::array<std::string_view, 8> kHarmless{
      "KHR_materials_", "KHR_texture_",   "EXT_texture_", "MSFT_texture_",
      "KHR_lights_",    "KHR_animation_", kDraco,         kQuantized};
  for (const Json& extension : listIn(document, "extensionsRequired")) {
    if (!extension.is_string())
      throw sim::InputError(fmt::format("extensionsRequired holds {}; expected names", shown(extension)));
    const std::string& name = extension.get_ref<const std::string&>();
    if (std::none_of(kHarmless.begin(), kHarmless.end(), [&](auto known) { return name.starts_with(known); }))
      throw sim::InputError(fmt::format("it needs the glTF extension {}, which is not read", inQuotes(name)));
  }
}

/// Looks at meshes, and copies of them what is read.
class Meshes {
 public:
  Meshes(const Json& document, Accessors& accessors, Vertices& vertices, const std::vector<Looks>& looks)
      : document_(document), accessors_(accessors), vertices_(vertices), looks_(looks) {
    const Json& used = listIn(document, "extensionsUsed");
    quantized_ = std::find(used.begin(), used.end(), kQuantized) != used.end();
  }

  Json read(const Json& mesh) {
    Json some = Json::object();
    keepName(mesh, some);
    const Json& primitives = objectsIn(mesh, "primitives");
    if (primitives.empty()) throw sim::InputError("it has no primitives");
    triangles_.push_back(0);
    for (const Json& primitive : primitives)
      some["primitives"].push_back(
          inPart("primitive", some["primitives"].size(), [&] { return readPrimitive(primitive); }));
    return some;
  }
  const std::vector<std::uint64_t>& triangles() const { return triangles_; }

 private:
  Json readPrimitive(const Json& primitive) {
    const Json& attributes = requiredObject(primitive, "attributes");
    const std::size_t position = requiredIndex(attributes, "POSITION", document_, "accessors");
    const auto indices = indexIn(primitive, "indices", document_, "accessors");
    const std::uint64_t mode = wholeIn(primitive, "mode").value_or(4);
    if (mode > 6) throw sim::InputError(fmt::format("mode is {}; expected 0 to 6", mode));
    const auto material = indexIn(primitive, "material", document_, "materials");
    Json some = only(primitive, {"indices", "material", "mode"});
    const bool packed = keepDraco(primitive, some);
    const Accessors::Accessor& places = accessors_.of(position);
    if (places.type != "VEC3" || (places.component != 5126 && !(quantized_ && places.component < 5124))) {
      throw sim::InputError(
          fmt::format("POSITION is accessor {} of {} and componentType {}; expected VEC3 and 5126", position,
                      places.type, places.component));
    }
    requireData(position, packed);
    std::uint64_t corners = places.count;
    if (indices) {
      requireData(*indices, packed);
      requireIndices(*indices, places.count);
      corners = accessors_.of(*indices).count;
    }
    corners_ += std::max(corners, places.count);
    if (corners_ > 3 * kMostTriangles) {
      throw sim::InputError(
          fmt::format("there are more than {} triangles; make the mesh simpler first", kMostTriangles));
    }
    if (mode >= 4) triangles_.back() += mode == 4 ? corners / 3 : std::max(corners, std::uint64_t{2}) - 2;
    if (!packed)
      some["attributes"] = vertices_.read(attributes, position, material ? &looks_[*material] : nullptr);
    return some;
  }

  /// Its decoder wants to see all of the attributes.
  bool keepDraco(const Json& primitive, Json& some) const {
    const auto extensions = primitive.find("extensions");
    if (extensions == primitive.end() || !extensions->contains(kDraco)) return false;
    const Json& draco = requiredObject(*extensions, kDraco);
    requiredIndex(draco, "bufferView", document_, "bufferViews");
    some["extensions"][kDraco] = only(draco, {"bufferView", "attributes"});
    some["attributes"] = primitive.at("attributes");
    for (const Json& attribute : some["attributes"]) indexOf(attribute, "attribute", document_, "accessors");
    return true;
  }

  void requireData(std::size_t accessor, bool packed) const {
    if (!packed && !accessors_.of(accessor).has_data)
      throw sim::InputError(fmt::format("accessor {} has no bufferView", accessor));
  }

  void requireIndices(std::size_t indices, std::uint64_t vertices) {
    const Accessors::Accessor& about = accessors_.of(indices);
    const bool whole = about.component == 5121 || about.component == 5123 || about.component == 5125;
    if (about.type != "SCALAR" || !whole) {
      throw sim::InputError(fmt::format(
          "indices are accessor {} of {} and componentType {}; expected SCALAR and 5121, 5123 or 5125",
          indices, about.type, about.component));
    }
    if (const std::uint64_t highest = accessors_.highest(indices); highest >= vertices) {
      throw sim::InputError(
          fmt::format("indices (accessor {}) ask for vertex {}, counted from 0, but there are {}", indices,
                      highest, vertices));
    }
  }

  const Json& document_;
  Accessors& accessors_;
  Vertices& vertices_;
  const std::vector<Looks>& looks_;
  bool quantized_ = false;
  std::vector<std::uint64_t> triangles_;
  std::uint64_t corners_ = 0;  // of all primitives: Assimp keeps each by itself
};

Json accessorOf(const Json& accessor) {
  Json some = only(accessor, {"bufferView", "byteOffset", "componentType", "count", "type"});
  const auto sparse = accessor.find("sparse");
  if (sparse == accessor.end()) return some;
  some["sparse"] = only(*sparse, {"count"});
  some["sparse"]["indices"] = only(sparse->at("indices"), {"bufferView", "byteOffset", "componentType"});
  some["sparse"]["values"] = only(sparse->at("values"), {"bufferView", "byteOffset"});
  return some;
}

/// Each entry of a list by `work`, whose errors name it.
template <class Work>
Json each(const Json& document, const char* list, const char* part, Work work) {
  Json some = Json::array();
  for (const Json& entry : objectsIn(document, list))
    some.push_back(inPart(part, some.size(), [&] { return work(entry); }));
  return some;
}

Checked checkDocument(const Json& document, const Container& container, const FileBeside& file_beside) {
  const std::string& version = requiredText(requiredObject(document, "asset"), "version");
  if (!version.starts_with("2.")) throw sim::InputError(fmt::format("glTF {} is not glTF 2", version));
  requireReadable(document);
  Checked checked{{}, Buffers(document, container, file_beside), {}, {}, 0};
  Accessors accessors(document, checked.buffers);
  TextureFiles textures;
  const std::vector<Looks> looks = looksOf(document, checked.buffers, file_beside, textures);
  for (const Looks& one : looks) checked.materials.push_back(one.material);
  Vertices vertices(document, accessors, checked.buffers);
  Meshes meshes(document, accessors, vertices, looks);

  Json some = {{"asset", {{"version", "2.0"}}}};
  some["meshes"] = each(document, "meshes", "mesh", [&](const Json& mesh) { return meshes.read(mesh); });
  // Their numbers are all that Assimp is asked for.
  some["materials"] = each(document, "materials", "material", [](const Json&) { return Json::object(); });
  checked.triangles = trianglesInScene(document, meshes.triangles());
  const std::size_t scene = indexIn(document, "scene", document, "scenes").value_or(0);
  some["scene"] = 0;
  some["scenes"] = Json::array({only(document["scenes"][scene], {"nodes"})});  // {json} may be a copy of it
  some["nodes"] = each(document, "nodes", "node", [](const Json& node) {
    Json kept = only(node, {"mesh", "children", "matrix", "translation", "rotation", "scale"});
    keepName(node, kept);
    return kept;
  });
  some["accessors"] = each(document, "accessors", "accessor", accessorOf);
  some["bufferViews"] = each(document, "bufferViews", "bufferView", [](const Json& view) {
    return only(view, {"buffer", "byteOffset", "byteLength", "byteStride"});
  });
  some["accessors"].insert(some["accessors"].end(), vertices.accessors().begin(), vertices.accessors().end());
  some["bufferViews"].insert(some["bufferViews"].end(), vertices.views().begin(), vertices.views().end());
  textures.warn(checked.warnings);
  if (!vertices.leftOut().empty())
    checked.warnings.push_back({{}, 0, 0, vertices.leftOut() + "; normals or UVs are left out"});
  for (std::size_t i = 0; i < checked.buffers.count(); ++i)
    some["buffers"].push_back({{"byteLength", checked.buffers.of(i).size()}, {"uri", bufferName(i)}});
  for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
    const Json& names = listIn(document, key);
    if (std::find(names.begin(), names.end(), kDraco) != names.end()) some[key] = Json::array({kDraco});
  }
  checked.json = some.dump();
  return checked;
}

}  // namespace

std::string bufferName(std::size_t number) {
  return fmt::format("buffer{}.bin", number);
}

Checked check(std::string_view file, const FileBeside& file_beside) {
  const Container container = containerOf(file);
  try {
    return checkDocument(Json::parse(container.json), container, file_beside);
  } catch (const Json::parse_error& error) {
    throw sim::InputError(
        fmt::format("the glTF file's JSON is damaged at byte {} of {}", error.byte, container.json.size()));
  } catch (const Json::exception&) {
    throw sim::InputError("a member of the glTF file's JSON is of another kind than glTF has it");
  }
}

}  // namespace espalier::scenes::gltf
