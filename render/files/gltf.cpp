#include "render/files/gltf.h"

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <span>
#include <sstream>
#include <string_view>

#include "sim/base/error.h"
#include "sim/base/stop.h"

namespace espalier::render {
namespace {

using Colour4 = std::array<std::uint8_t, 4>;
constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

// A .glb's header of three words, and that of a chunk of two.
constexpr std::size_t kWord = 4, kHeader = 12, kChunkHeader = 8;

constexpr double kStoneRoughness = 0.9, kLeafRoughness = 0.6;

/// Names come from other people's files; JSON takes valid UTF-8 only.
std::string validUtf8(const std::string& name) {
  using nlohmann::json;
  return json::parse(json(name).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

int sizeOf(const auto& container) {
  return static_cast<int>(container.size());
}

tinygltf::Value extras(const sim::Provenance& made_by) {
  tinygltf::Value::Array inputs;
  for (const sim::InputFile& input : made_by.inputs) {
    inputs.emplace_back(tinygltf::Value::Object{{"file", tinygltf::Value(validUtf8(input.name))},
                                                {"kind", tinygltf::Value(input.kind)},
                                                {"xxh3", tinygltf::Value(sim::hexOf(input.hash))}});
  }
  // As text: of JSON's numbers tinygltf writes 32 bits or a real one.
  return tinygltf::Value(tinygltf::Value::Object{{"seed", tinygltf::Value(std::to_string(made_by.seed))},
                                                 {"inputs", tinygltf::Value(std::move(inputs))}});
}

/// Writes the buffer, and knows what the file says of it. Without a stream it measures alone.
class GlbWriter {
 public:
  GlbWriter(const sim::Provenance& made_by, std::ostream* buffer) : buffer_(buffer) {
    model_.asset.version = "2.0";
    model_.asset.generator = made_by.software.empty() ? "Espalier" : validUtf8(made_by.software);
    if (!made_by.software.empty()) model_.asset.extras = extras(made_by);
    model_.scenes.resize(1);
    model_.defaultScene = 0;
  }

  void addMesh(const sim::Mesh& mesh);
  void addPlant(const PlantModel& plant);
  /// Fills the buffer up to whole words.
  void finish() { align(); }
  std::size_t bufferBytes() const { return bytes_; }
  std::string json() const;

 private:
  void align();
  template <class T>
  int accessor(std::span<const T> data, int component_type, int type, int target, bool normalized = false);
  int positions(std::span<const sim::Vec3f> data);
  int material(const std::string& name, sim::Colour colour, bool double_sided, double roughness);
  int node(const std::string& name, int mesh);
  int surface(const ModelMesh& mesh, const std::string& material_name, bool double_sided);

  std::ostream* buffer_;
  std::size_t bytes_ = 0;  // of the buffer
  tinygltf::Model model_;
  std::map<std::tuple<std::string, float, float, float, bool>, int> materials_;
};

void GlbWriter::align() {
  for (; bytes_ % 4 != 0; ++bytes_) {
    if (buffer_ != nullptr) buffer_->put('\0');
  }
}

template <class T>
int GlbWriter::accessor(std::span<const T> data, int component_type, int type, int target, bool normalized) {
  align();  // glTF aligns every accessor to its component's size
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = bytes_;
  view.byteLength = data.size_bytes();
  view.target = target;
  if (buffer_ != nullptr)
    buffer_->write(reinterpret_cast<const char*>(data.data()), static_cast<std::streamsize>(view.byteLength));
  bytes_ += view.byteLength;
  model_.bufferViews.push_back(std::move(view));

  tinygltf::Accessor result;
  result.bufferView = sizeOf(model_.bufferViews) - 1;
  result.componentType = component_type;
  result.type = type;
  result.count = data.size();
  result.normalized = normalized;
  model_.accessors.push_back(std::move(result));
  return sizeOf(model_.accessors) - 1;
}

int GlbWriter::positions(std::span<const sim::Vec3f> data) {
  const int index =
      accessor(data, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  sim::Vec3f low = data[0], high = data[0];
  for (const sim::Vec3f p : data) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  model_.accessors.back().minValues = {low.x, low.y, low.z};
  model_.accessors.back().maxValues = {high.x, high.y, high.z};
  return index;
}

int GlbWriter::material(const std::string& name, sim::Colour colour, bool double_sided, double roughness) {
  const auto [found, added] =
      materials_.try_emplace({name, colour.r, colour.g, colour.b, double_sided}, sizeOf(model_.materials));
  if (added) {
    tinygltf::Material material;
    material.name = validUtf8(name);
    const auto factor = [](float c) { return std::clamp(static_cast<double>(c), 0.0, 1.0); };
    material.pbrMetallicRoughness.baseColorFactor = {factor(colour.r), factor(colour.g), factor(colour.b),
                                                     1.0};
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = roughness;
    material.doubleSided = double_sided;
    model_.materials.push_back(std::move(material));
  }
  return found->second;
}

int GlbWriter::node(const std::string& name, int mesh) {
  tinygltf::Node node;
  node.name = validUtf8(name);
  node.mesh = mesh;
  model_.nodes.push_back(std::move(node));
  return sizeOf(model_.nodes) - 1;
}

/// One primitive for each material that is in use, with the vertices that it uses.
void GlbWriter::addMesh(const sim::Mesh& mesh) {
  tinygltf::Mesh result;
  result.name = validUtf8(mesh.name);
  std::vector<std::vector<std::size_t>> triangles_of(mesh.materials.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.material[t] < triangles_of.size()) triangles_of[mesh.material[t]].push_back(t);
  }
  std::vector<std::uint32_t> number(mesh.vertices_m.size(), kUnused);
  for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
    std::vector<std::uint32_t> indices;
    std::vector<sim::Vec3f> vertices;
    for (const std::size_t t : triangles_of[m]) {
      for (const std::uint32_t corner : mesh.triangles[t]) {
        if (corner >= number.size()) {
          throw sim::InputError(fmt::format("mesh '{}': triangle {} uses vertex {} of {}", mesh.name, t,
                                            corner, number.size()));
        }
        if (number[corner] == kUnused) {
          number[corner] = static_cast<std::uint32_t>(vertices.size());
          vertices.emplace_back(mesh.vertices_m[corner]);
        }
        indices.push_back(number[corner]);
      }
    }
    for (const std::size_t t : triangles_of[m]) {
      for (const std::uint32_t corner : mesh.triangles[t]) number[corner] = kUnused;
    }
    if (indices.empty()) continue;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = positions(vertices);
    primitive.indices = accessor<std::uint32_t>(indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                                TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    // Scene meshes may be inside out; a wall that vanishes from behind would be worse than one drawn twice.
    primitive.material = material(mesh.materials[m].name, mesh.materials[m].colour, true, kStoneRoughness);
    result.primitives.push_back(std::move(primitive));
  }
  if (result.primitives.empty()) return;
  model_.meshes.push_back(std::move(result));
  model_.scenes[0].nodes.push_back(node(mesh.name, sizeOf(model_.meshes) - 1));
}

int GlbWriter::surface(const ModelMesh& mesh, const std::string& material_name, bool double_sided) {
  std::vector<Colour4> greys;
  greys.reserve(mesh.exposures.size());
  for (const float exposure : mesh.exposures) {
    const auto grey = static_cast<std::uint8_t>(std::lround(std::clamp(exposure, 0.0f, 1.0f) * 255.0f));
    greys.push_back({grey, grey, grey, 255});
  }
  std::vector<glm::vec2> uvs;  // glTF counts v from the top
  uvs.reserve(mesh.uvs.size());
  for (const glm::vec2 uv : mesh.uvs) uvs.emplace_back(uv.x, 1.0f - uv.y);

  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = positions(mesh.positions_m);
  primitive.attributes["NORMAL"] = accessor<sim::Vec3f>(mesh.normals, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                                        TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.attributes["TEXCOORD_0"] = accessor<glm::vec2>(uvs, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                                           TINYGLTF_TYPE_VEC2, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.attributes["COLOR_0"] = accessor<Colour4>(greys, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                                                      TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER, true);
  primitive.indices =
      accessor<std::array<std::uint32_t, 3>>(mesh.triangles, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                             TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  model_.accessors.back().count = 3 * mesh.triangles.size();
  primitive.material = material(material_name, mesh.base_colour, double_sided,
                                double_sided ? kLeafRoughness : kStoneRoughness);
  tinygltf::Mesh result;
  result.name = validUtf8(mesh.name);
  result.primitives.push_back(std::move(primitive));
  model_.meshes.push_back(std::move(result));
  return node(mesh.name, sizeOf(model_.meshes) - 1);
}

/// A plant's meshes are named after it; their materials, which plants share, after the shape alone.
std::string kindOf(const PlantModel& plant, const ModelMesh& element) {
  const std::string prefix = plant.name + " ";
  return element.name.starts_with(prefix) ? element.name.substr(prefix.size()) : element.name;
}

void GlbWriter::addPlant(const PlantModel& plant) {
  std::vector<int> children;
  if (!plant.stems.empty()) children.push_back(surface(plant.stems, "stems", false));
  if (!plant.stalks.empty()) children.push_back(surface(plant.stalks, "stalks", false));
  for (const ModelMesh& element : plant.elements) {
    if (!element.empty()) children.push_back(surface(element, kindOf(plant, element), true));
  }
  if (children.empty()) return;
  const int parent = node(plant.name, -1);
  model_.nodes[static_cast<std::size_t>(parent)].children = std::move(children);
  model_.scenes[0].nodes.push_back(parent);
}

/// As tinygltf writes it, with our buffer for one of its own.
std::string GlbWriter::json() const {
  tinygltf::Model model = model_;
  if (model.nodes.empty()) {  // glTF forbids empty buffers and scenes of nothing
    model.scenes.clear();
    model.defaultScene = -1;
  } else {
    model.buffers.resize(1);
    model.buffers[0].data.resize(kWord);
  }
  std::ostringstream out;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, false, true))
    throw sim::InputError("the glTF writer failed");
  const std::string file = std::move(out).str();
  std::uint32_t length = 0;
  std::memcpy(&length, file.data() + kHeader, sizeof length);
  auto json = nlohmann::json::parse(std::string_view(file).substr(kHeader + kChunkHeader, length));
  if (!model.buffers.empty()) json["buffers"][0]["byteLength"] = bytes_;
  return json.dump();
}

void putWords(std::ostream& out, std::initializer_list<std::size_t> words) {
  for (const std::size_t word : words) {
    for (unsigned byte = 0; byte < kWord; ++byte) out.put(static_cast<char>(word >> (8 * byte) & 0xffu));
  }
}

}  // namespace

void writeGlb(std::ostream& file, const std::vector<const sim::Mesh*>& meshes, const PlantModels& plants,
              const sim::Provenance& made_by) {
  const auto addAll = [&](GlbWriter& writer) {
    for (const sim::Mesh* mesh : meshes) {
      sim::throwIfStopped();
      writer.addMesh(*mesh);
    }
    plants([&](const PlantModel& plant) {
      sim::throwIfStopped();
      writer.addPlant(plant);
    });
    writer.finish();
  };
  GlbWriter measured(made_by, nullptr);
  addAll(measured);
  std::string json = measured.json();
  json.resize((json.size() + kWord - 1) / kWord * kWord, ' ');
  const std::size_t buffer = measured.bufferBytes();
  const std::size_t all = kHeader + kChunkHeader + json.size() + (buffer > 0 ? kChunkHeader + buffer : 0);
  if (all > std::numeric_limits<std::uint32_t>::max()) {
    throw sim::InputError(fmt::format("the plants' surfaces take {:.1f} GB; a .glb file holds at most 4",
                                      static_cast<double>(all) / 1e9));
  }
  putWords(file, {0x46546c67, 2, all, json.size(), 0x4e4f534a});  // "glTF", its version; "JSON"
  file << json;
  if (buffer == 0) return;
  putWords(file, {buffer, 0x004e4942});  // "BIN"
  GlbWriter written(made_by, &file);
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
