#include "scenes/import/gltf_vertices.h"

#include <cstring>
#include <glm/vec3.hpp>

namespace espalier::scenes::gltf {

namespace {

constexpr std::uint64_t kFloats = 5126;

}  // namespace

Vertices::Vertices(const Json& document, const Accessors& accessors, Buffers& buffers)
    : document_(document), accessors_(accessors), buffers_(buffers) {}

Json Vertices::read(const Json& attributes, std::size_t position, const Looks* looks) {
  Json some = {{"POSITION", floats(position)}};
  const std::uint64_t count = accessors_.of(position).count;
  const auto leaveOut = [&](const std::string& why) {
    if (left_out_.empty()) left_out_ = why;
    return std::optional<std::size_t>();
  };
  const auto find = [&](const std::string& key, const char* type) {
    std::optional<std::size_t> accessor;
    try {
      accessor = indexIn(attributes, key.c_str(), document_, "accessors");
    } catch (const sim::InputError& error) {
      return leaveOut(error.what());
    }
    if (!accessor) return accessor;
    const Accessors::Accessor& about = accessors_.of(*accessor);
    if (about.type == type && about.count == count && about.has_data) return accessor;
    return leaveOut(fmt::format("{} is accessor {} of {} {}; expected {} {} with data", key, *accessor,
                                about.count, about.type, count, type));
  };
  if (const auto normal = find("NORMAL", "VEC3")) some["NORMAL"] = floats(*normal);
  const std::size_t set = looks != nullptr ? looks->uv_set : 0;
  if (const auto uv = find(fmt::format("TEXCOORD_{}", set), "VEC2"))
    some["TEXCOORD_0"] =
        looks != nullptr && looks->uv_from_uv != glm::dmat3(1.0) ? moved(*uv, *looks) : floats(*uv);
  return some;
}

std::size_t Vertices::floats(std::size_t accessor) {
  const Accessors::Accessor& about = accessors_.of(accessor);
  if (about.component == kFloats) return accessor;
  const auto [known, is_new] = known_.try_emplace({accessor, nullptr}, 0);
  if (is_new) known->second = add(accessors_.floatsOf(accessor), about.type, about.count);
  return known->second;
}

std::size_t Vertices::moved(std::size_t accessor, const Looks& looks) {
  const auto [known, is_new] = known_.try_emplace({accessor, &looks}, 0);
  if (!is_new) return known->second;
  std::vector<float> uvs = accessors_.floatsOf(accessor);
  for (std::size_t i = 0; i + 1 < uvs.size(); i += 2) {
    const glm::dvec3 uv = looks.uv_from_uv * glm::dvec3(uvs[i], uvs[i + 1], 1.0);
    uvs[i] = static_cast<float>(uv.x);
    uvs[i + 1] = static_cast<float>(uv.y);
  }
  return known->second = add(std::move(uvs), "VEC2", accessors_.of(accessor).count);
}

std::size_t Vertices::add(std::vector<float> values, const std::string& type, std::uint64_t count) {
  std::vector<unsigned char> bytes(values.size() * sizeof(float));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  const std::size_t view = objectsIn(document_, "bufferViews").size() + new_views_.size();
  new_views_.push_back({{"byteLength", bytes.size()}, {"buffer", buffers_.add(std::move(bytes))}});
  new_accessors_.push_back(
      {{"bufferView", view}, {"componentType", kFloats}, {"count", count}, {"type", type}});
  return objectsIn(document_, "accessors").size() + new_accessors_.size() - 1;
}

}  // namespace espalier::scenes::gltf
