#pragma once
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/import/gltf_json.h"

namespace espalier::scenes::gltf {

/// A file beside the mesh, by the name that the mesh gives it; null where it is not to be read. What it gives
/// stays where it is.
using FileBeside = std::function<const std::string*(const std::string& name)>;

/// A .gltf or .glb file's two parts (glTF 2.0, section 4.4).
struct Container {
  std::string_view json;
  std::optional<std::string_view> binary;  ///< what the first buffer of a .glb may lie in
};

/// Throws sim::InputError where lengths in a .glb's headers do not fit its own.
Container containerOf(std::string_view file);

/// What a data URI holds. Throws sim::InputError where it is not base64.
std::vector<unsigned char> decodedUri(const std::string& uri);

/// The bytes of the document's buffers, each as many as it says.
class Buffers {
 public:
  /// Looks for all of them, and takes no room but that of base64 that is decoded. Throws sim::InputError,
  /// naming the buffer, for one that is not there or is shorter than it says.
  Buffers(const Json& document, const Container& container, const FileBeside& file_beside);

  /// One more, of our own; its number.
  std::size_t add(std::vector<unsigned char> bytes);

  std::string_view of(std::size_t buffer) const { return bytes_[buffer]; }
  std::size_t count() const { return bytes_.size(); }

 private:
  std::string_view find(const Json& buffer, std::size_t number, const Container& container,
                        const FileBeside& file_beside);

  std::vector<std::string_view> bytes_;
  std::deque<std::vector<unsigned char>> decoded_;
};

}  // namespace espalier::scenes::gltf
