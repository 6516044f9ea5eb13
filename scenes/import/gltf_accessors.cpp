#include "scenes/import/gltf_accessors.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "scenes/problem.h"

namespace espalier::scenes::gltf {
namespace {

constexpr std::uint64_t kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                        kUnsignedInt = 5125, kFloat = 5126;

std::uint64_t sizeOfComponent(std::uint64_t component) {
  switch (component) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      throw sim::InputError(
          fmt::format("componentType is {}; expected one of 5120, 5121, 5122, 5123, 5125, 5126", component));
  }
}

struct Shape {
  const char* type;
  std::uint64_t columns, rows;
};

const Shape& shapeOf(const std::string& type) {
  static constexpr std::array<Shape, 7> kShapes{{{"SCALAR", 1, 1},
                                                 {"VEC2", 1, 2},
                                                 {"VEC3", 1, 3},
                                                 {"VEC4", 1, 4},
                                                 {"MAT2", 2, 2},
                                                 {"MAT3", 3, 3},
                                                 {"MAT4", 4, 4}}};
  const auto shape =
      std::find_if(kShapes.begin(), kShapes.end(), [&](const Shape& s) { return type == s.type; });
  if (shape == kShapes.end())
    throw sim::InputError(
        fmt::format("type is {}; expected SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4", inQuotes(type)));
  return *shape;
}

/// Columns of matrices begin at whole words.
std::uint64_t sizeOfElement(const std::string& type, std::uint64_t component) {
  const Shape& shape = shapeOf(type);
  const std::uint64_t column = shape.rows * sizeOfComponent(component);
  return shape.columns == 1 ? column : shape.columns * ((column + 3) / 4 * 4);
}

template <class Number>
Number valueAt(const char* at) {
  Number number;
  std::memcpy(&number, at, sizeof number);
  return number;
}

template <class Number>
std::uint64_t numberAt(const char* at) {
  return valueAt<Number>(at);
}

std::uint64_t wholeAt(const char* at, std::uint64_t component) {
  if (component == kUnsignedByte) return numberAt<std::uint8_t>(at);
  if (component == kUnsignedShort) return numberAt<std::uint16_t>(at);
  return numberAt<std::uint32_t>(at);
}

template <class Number>
float floatOf(const char* at, bool normalized) {
  const auto value = static_cast<float>(valueAt<Number>(at));
  return normalized ? std::max(value / static_cast<float>(std::numeric_limits<Number>::max()), -1.0f) : value;
}

float componentAt(const char* at, std::uint64_t component, bool normalized) {
  switch (component) {
    case kByte:
      return floatOf<std::int8_t>(at, normalized);
    case kUnsignedByte:
      return floatOf<std::uint8_t>(at, normalized);
    case kShort:
      return floatOf<std::int16_t>(at, normalized);
    case kUnsignedShort:
      return floatOf<std::uint16_t>(at, normalized);
    case kUnsignedInt:
      return floatOf<std::uint32_t>(at, normalized);
    default:
      return valueAt<float>(at);
  }
}

}  // namespace

Accessors::Accessors(const Json& document, const Buffers& buffers) {
  for (const Json& view : objectsIn(document, "bufferViews")) {
    inPart("bufferView", views_.size(), [&] {
      const std::size_t buffer = requiredIndex(view, "buffer", document, "buffers");
      const std::string_view bytes = buffers.of(buffer);
      const std::uint64_t offset = wholeIn(view, "byteOffset").value_or(0);
      const std::uint64_t length = requiredWhole(view, "byteLength");
      if (offset + length > bytes.size()) {
        throw sim::InputError(fmt::format("it reaches to byte {} of buffer {}, which has {}", offset + length,
                                          buffer, bytes.size()));
      }
      views_.push_back({bytes.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length)),
                        wholeIn(view, "byteStride").value_or(0)});
    });
  }
  for (const Json& accessor : objectsIn(document, "accessors")) {
    inPart("accessor", accessors_.size(), [&] { accessors_.push_back(accessorOf(accessor, document)); });
  }
}

Accessors::Known Accessors::accessorOf(const Json& json, const Json& document) const {
  const std::string type = json.contains("type") ? requiredText(json, "type") : std::string();
  const std::uint64_t component = requiredWhole(json, "componentType");
  const std::uint64_t size = sizeOfElement(type, component);
  const std::uint64_t count = requiredWhole(json, "count");
  if (count == 0) throw sim::InputError("count is 0; expected 1 or more");
  const auto view = indexIn(json, "bufferView", document, "bufferViews");
  const bool is_sparse = json.contains("sparse");
  const auto normalized = json.find("normalized");
  const bool is_normalized = normalized != json.end() && normalized->is_boolean() && normalized->get<bool>();
  Known known{{type, component, is_normalized, count, view || is_sparse}, {}, {}, {}, {}};
  if (view) known.dense = elementsIn(json, *view, count, component, size, false);
  if (!is_sparse) return known;
  const Json& sparse = requiredObject(json, "sparse");
  const std::uint64_t changed = requiredWhole(sparse, "count");
  if (changed == 0 || changed > count)
    throw sim::InputError(fmt::format("sparse.count is {}; expected 1 to {}", changed, count));
  const Json& indices = requiredObject(sparse, "indices");
  const Json& values = requiredObject(sparse, "values");
  const std::uint64_t number = requiredWhole(indices, "componentType");
  if (number != kUnsignedByte && number != kUnsignedShort && number != kUnsignedInt) {
    throw sim::InputError(
        fmt::format("sparse.indices.componentType is {}; expected 5121, 5123 or 5125", number));
  }
  known.sparse_indices = elementsIn(indices, requiredIndex(indices, "bufferView", document, "bufferViews"),
                                    changed, number, sizeOfComponent(number), true);
  known.sparse_values = elementsIn(values, requiredIndex(values, "bufferView", document, "bufferViews"),
                                   changed, component, size, true);
  const std::uint64_t last = highestOf(*known.sparse_indices);
  if (last >= count)
    throw sim::InputError(fmt::format("sparse.indices change element {}, but there are {}", last, count));
  return known;
}

Accessors::Elements Accessors::elementsIn(const Json& place, std::size_t view, std::uint64_t count,
                                          std::uint64_t component, std::uint64_t size,
                                          bool side_by_side) const {
  const std::string_view bytes = views_[view].bytes;
  const std::uint64_t offset = wholeIn(place, "byteOffset").value_or(0);
  const std::uint64_t stride = side_by_side || views_[view].stride == 0 ? size : views_[view].stride;
  if (stride < size) {
    throw sim::InputError(
        fmt::format("its elements of {} bytes begin every {} bytes of bufferView {}", size, stride, view));
  }
  if (offset + size > bytes.size() || (count - 1) > (bytes.size() - offset - size) / stride) {
    const auto end = static_cast<double>(offset) +
                     static_cast<double>(stride) * static_cast<double>(count - 1) + static_cast<double>(size);
    throw sim::InputError(fmt::format("its {} elements reach to byte {:.0f} of bufferView {}, which has {}",
                                      count, end, view, bytes.size()));
  }
  return {bytes.data() + offset, count, stride, component};
}

std::uint64_t Accessors::highestOf(const Elements& elements) {
  const auto highest = [&](auto numberAt) {
    std::uint64_t most = 0;
    for (std::uint64_t i = 0; i < elements.count; ++i)
      most = std::max(most, numberAt(elements.first + i * elements.stride));
    return most;
  };
  if (elements.component == kUnsignedByte) return highest(numberAt<std::uint8_t>);
  if (elements.component == kUnsignedShort) return highest(numberAt<std::uint16_t>);
  return highest(numberAt<std::uint32_t>);
}

std::vector<float> Accessors::floatsOf(std::size_t accessor) const {
  const Known& known = accessors_[accessor];
  const Accessor& about = known.about;
  const Shape& shape = shapeOf(about.type);
  const std::uint64_t each = shape.columns * shape.rows, bytes = sizeOfComponent(about.component);
  std::vector<float> values(static_cast<std::size_t>(about.count * each), 0.0f);
  const auto put = [&](const char* element, std::uint64_t place) {
    for (std::uint64_t k = 0; k < each; ++k) {
      values[static_cast<std::size_t>(place * each + k)] =
          componentAt(element + k * bytes, about.component, about.normalized);
    }
  };
  for (std::uint64_t i = 0; known.dense && i < about.count; ++i) put(known.dense->at(i), i);
  for (std::uint64_t i = 0; known.sparse_values && i < known.sparse_values->count; ++i)
    put(known.sparse_values->at(i), wholeAt(known.sparse_indices->at(i), known.sparse_indices->component));
  return values;
}

std::uint64_t Accessors::highest(std::size_t accessor) {
  Known& known = accessors_[accessor];
  if (!known.highest) {
    known.highest = 0;
    if (known.dense) known.highest = highestOf(*known.dense);
    if (known.sparse_values) known.highest = std::max(*known.highest, highestOf(*known.sparse_values));
  }
  return *known.highest;
}

}  // namespace espalier::scenes::gltf
