#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scenes/import/gltf_buffers.h"

namespace espalier::scenes::gltf {

/// A file's buffer views and accessors, of which every element that they promise is there.
class Accessors {
 public:
  /// Looks at all of them. Throws sim::InputError, naming the view or the accessor. Borrows the buffers.
  Accessors(const Json& document, const Buffers& buffers);

  struct Accessor {
    std::string type;         ///< SCALAR, VEC3 ...
    std::uint64_t component;  ///< OpenGL's number of the components' type
    bool normalized;          ///< whole numbers stand for -1 or 0 to 1
    std::uint64_t count;      ///< of elements
    bool has_data;            ///< else all are zero, or come from an extension
  };
  const Accessor& of(std::size_t accessor) const { return accessors_[accessor].about; }

  /// An accessor's components, one after the other.
  std::vector<float> floatsOf(std::size_t accessor) const;
  /// The greatest of an accessor's whole numbers; found once.
  std::uint64_t highest(std::size_t accessor);

 private:
  struct View {
    std::string_view bytes;
    std::uint64_t stride;  ///< 0: elements lie side by side
  };
  /// Elements in a view.
  struct Elements {
    const char* first = nullptr;
    std::uint64_t count = 0, stride = 0, component = 0;
    const char* at(std::uint64_t element) const { return first + element * stride; }
  };
  struct Known {
    Accessor about;
    std::optional<Elements> dense, sparse_indices, sparse_values;
    std::optional<std::uint64_t> highest;
  };

  Elements elementsIn(const Json& place, std::size_t view, std::uint64_t count, std::uint64_t component,
                      std::uint64_t size, bool side_by_side) const;
  Known accessorOf(const Json& json, const Json& document) const;
  static std::uint64_t highestOf(const Elements& elements);

  std::vector<View> views_;
  std::vector<Known> accessors_;
};

}  // namespace espalier::scenes::gltf
