#include "render/files/glb_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <istream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "render/files/glb_words.h"
#include "sim/base/error.h"

namespace espalier::render {
namespace {

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

void putWords(std::ostream& out, std::initializer_list<std::size_t> words) {
  for (const std::size_t word : words) {
    for (unsigned byte = 0; byte < kGlbWord; ++byte) out.put(static_cast<char>(word >> (8 * byte) & 0xffu));
  }
}

void requireFits(std::size_t bytes) {
  if (bytes <= std::numeric_limits<std::uint32_t>::max()) return;
  throw sim::InputError("the surfaces take more than 4 GB, and a .glb file holds no more");
}

}  // namespace

std::string validUtf8(const std::string& name) {
  using nlohmann::json;
  return json::parse(json(name).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

void setExtent(tinygltf::Accessor& accessor, std::span<const sim::Vec3f> places) {
  sim::Vec3f low = places[0], high = low;
  for (const sim::Vec3f place : places) {
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  for (int axis = 0; axis < 3; ++axis) {
    accessor.minValues.push_back(static_cast<double>(low[axis]));
    accessor.maxValues.push_back(static_cast<double>(high[axis]));
  }
}

std::vector<glm::vec2> turnedUvs(std::span<const glm::vec2> uvs) {
  std::vector<glm::vec2> turned;
  turned.reserve(uvs.size());
  for (const glm::vec2 uv : uvs) turned.emplace_back(uv.x, 1.0f - uv.y);
  return turned;
}

GlbFile::GlbFile(const sim::Provenance& made_by, std::ostream& buffer) : buffer_(buffer) {
  model_.asset.version = "2.0";
  model_.asset.generator = made_by.software.empty() ? "Espalier" : validUtf8(made_by.software);
  if (!made_by.software.empty()) model_.asset.extras = extras(made_by);
  model_.scenes.resize(1);
  model_.defaultScene = 0;
}

void GlbFile::align() {
  for (; bytes_ % kGlbWord != 0; ++bytes_) buffer_.put('\0');
}

void GlbFile::put(const void* data, std::size_t bytes, tinygltf::BufferView& view) {
  align();  // glTF aligns every accessor to its component's size
  view.buffer = 0;
  view.byteOffset = bytes_;
  view.byteLength = bytes;
  bytes_ += view.byteLength;
  requireFits(bytes_);
  buffer_.write(static_cast<const char*>(data), static_cast<std::streamsize>(view.byteLength));
}

int GlbFile::view(const void* data, std::size_t bytes, int target) {
  tinygltf::BufferView& view = model_.bufferViews.emplace_back();
  view.target = target;
  put(data, bytes, view);
  return sizeOf(model_.bufferViews) - 1;
}

int GlbFile::repeatedView(const void* data, std::size_t bytes, int target) {
  const std::string_view wanted(static_cast<const char*>(data), bytes);
  for (Repeated& other : repeated_) {
    if (model_.bufferViews[static_cast<std::size_t>(other.view)].target != target) continue;
    if (wanted.starts_with(other.bytes)) other.bytes = wanted;
    if (other.bytes.starts_with(wanted)) return other.view;
  }
  model_.bufferViews.emplace_back().target = target;
  repeated_.push_back({sizeOf(model_.bufferViews) - 1, std::string(wanted)});
  return repeated_.back().view;
}

void GlbFile::finish() {
  for (const Repeated& one : repeated_)
    put(one.bytes.data(), one.bytes.size(), model_.bufferViews[static_cast<std::size_t>(one.view)]);
  align();
}

int GlbFile::accessor(const void* data, std::size_t bytes, std::size_t count, int component_type, int type,
                      int target, bool normalized, bool repeat) {
  tinygltf::Accessor result;
  result.bufferView = repeat ? repeatedView(data, bytes, target) : view(data, bytes, target);
  const auto packed =
      static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type)) *
                               tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
  // It has to be said, too, where several accessors see vertices in one view.
  if (bytes != count * packed || (repeat && target == TINYGLTF_TARGET_ARRAY_BUFFER))
    model_.bufferViews[static_cast<std::size_t>(result.bufferView)].byteStride = bytes / count;
  result.componentType = component_type;
  result.type = type;
  result.count = count;
  result.normalized = normalized;
  model_.accessors.push_back(std::move(result));
  return sizeOf(model_.accessors) - 1;
}

int GlbFile::positions(std::span<const sim::Vec3f> data) {
  const int index = vertices(data, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
  setExtent(model_.accessors.back(), data);
  return index;
}

namespace {

void addOnce(std::vector<std::string>& names, const std::string& name) {
  const auto at = std::lower_bound(names.begin(), names.end(), name);
  if (at == names.end() || *at != name) names.insert(at, name);
}

}  // namespace

void GlbFile::require(const std::string& extension) {
  addOnce(model_.extensionsRequired, extension);
  use(extension);
}

void GlbFile::use(const std::string& extension) {
  addOnce(model_.extensionsUsed, extension);
}

int GlbFile::uvs(std::span<const glm::vec2> data, bool blades) {
  const auto inside = [](glm::vec2 uv) {
    return uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f;
  };
  if (blades && std::all_of(data.begin(), data.end(), inside)) {
    using Shorts = std::array<std::uint16_t, 2>;
    const auto shortOf = [](float share) {
      return static_cast<std::uint16_t>(std::lround(share * 65535.0f));
    };
    std::vector<Shorts> shorts;
    shorts.reserve(data.size());
    for (const glm::vec2 uv : data) shorts.push_back({shortOf(uv.x), shortOf(1.0f - uv.y)});
    return accessor(shorts.data(), sizeof(Shorts) * shorts.size(), shorts.size(),
                    TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC2, TINYGLTF_TARGET_ARRAY_BUFFER,
                    true, true);
  }
  return vertices<glm::vec2>(turnedUvs(data), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2);
}

int GlbFile::indices(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices,
                     bool repeat) {
  const std::size_t count = 3 * triangles.size();
  if (vertices > kMostShort) {
    return accessor(triangles.data(), triangles.size_bytes(), count, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                    TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, false);
  }
  std::vector<std::uint16_t> corners;
  corners.reserve(count);
  for (const auto& triangle : triangles) {
    for (const std::uint32_t corner : triangle) corners.push_back(static_cast<std::uint16_t>(corner));
  }
  return accessor(corners.data(), 2 * count, count, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                  TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, false, repeat);
}

int GlbFile::bytes(std::string_view data) {
  return view(data.data(), data.size(), 0);
}

int GlbFile::node(const std::string& name, int mesh) {
  tinygltf::Node node;
  node.name = validUtf8(name);
  node.mesh = mesh;
  model_.nodes.push_back(std::move(node));
  return sizeOf(model_.nodes) - 1;
}

/// As tinygltf writes it, with our buffer for one of its own.
std::string GlbFile::json() const {
  tinygltf::Model model = model_;
  if (model.nodes.empty()) {  // glTF forbids empty buffers and scenes of nothing
    model.scenes.clear();
    model.defaultScene = -1;
  } else {
    model.buffers.resize(1);
    model.buffers[0].data.resize(kGlbWord);
  }
  std::ostringstream out;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, false, true))
    throw sim::InputError("the glTF writer failed");
  const std::string file = std::move(out).str();
  std::uint32_t length = 0;
  std::memcpy(&length, file.data() + kGlbHeader, sizeof length);
  auto json = nlohmann::json::parse(std::string_view(file).substr(kGlbHeader + kGlbChunkHeader, length));
  if (!model.buffers.empty()) json["buffers"][0]["byteLength"] = bytes_;
  return json.dump();
}

namespace {

/// Moves the last bytes of a stream on, which is where they end, from the end to the beginning.
void moveOn(std::iostream& file, std::streamoff begin, std::size_t bytes, std::size_t by) {
  constexpr std::size_t kBlock = std::size_t{1} << 22u;
  file << std::string(by, '\0');  // not all streams can be sought in beyond their end
  std::vector<char> block(std::min(kBlock, bytes));
  for (std::size_t left = bytes; left > 0;) {
    const std::size_t size = std::min(kBlock, left);
    left -= size;
    const std::streamoff from = begin + static_cast<std::streamoff>(left);
    file.seekg(from);
    if (!file.read(block.data(), static_cast<std::streamsize>(size)))
      throw std::ios_base::failure("what was written cannot be read back");
    file.seekp(from + static_cast<std::streamoff>(by));
    file.write(block.data(), static_cast<std::streamsize>(size));
  }
}

}  // namespace

void writeGlbFile(std::iostream& file, const sim::Provenance& made_by,
                  const std::function<void(GlbFile&)>& add_all) {
  const std::streamoff begin = file.tellp();
  GlbFile written(made_by, file);
  add_all(written);
  written.finish();
  std::string json = written.json();
  json.resize((json.size() + kGlbWord - 1) / kGlbWord * kGlbWord, ' ');
  const std::size_t buffer = written.bufferBytes();
  const std::size_t before = kGlbHeader + kGlbChunkHeader + json.size() + (buffer > 0 ? kGlbChunkHeader : 0);
  requireFits(before + buffer);
  moveOn(file, begin, buffer, before);
  file.seekp(begin);
  putWords(file, {0x46546c67, 2, before + buffer, json.size(), 0x4e4f534a});  // "glTF", its version; "JSON"
  file << json;
  if (buffer > 0) putWords(file, {buffer, 0x004e4942});  // "BIN"
  file.seekp(begin + static_cast<std::streamoff>(before + buffer));
}

}  // namespace espalier::render
