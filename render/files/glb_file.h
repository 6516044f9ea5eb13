#pragma once
// Internal to the wing, and heavy: it brings tinygltf along.
#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/provenance.h"
#include "sim/base/vec.h"

namespace espalier::render {

/// Vertices that 16 bits can name: the greatest number is not an index, it restarts strips.
inline constexpr std::size_t kMostShort = 65535;

/// A .glb file while it is made: its buffer, which goes into a stream, and what its JSON says of that.
class GlbFile {
 public:
  GlbFile(const sim::Provenance& made_by, std::ostream& buffer);

  /// Adds an accessor of the data. Elements of vertices have multiples of 4 bytes, as glTF wants them: of
  /// what is longer than its type the rest is not looked at.
  template <class T>
  int vertices(std::span<const T> data, int component_type, int type, bool normalized = false) {
    static_assert(sizeof(T) % 4 == 0);
    return accessor(data.data(), data.size_bytes(), data.size(), component_type, type,
                    TINYGLTF_TARGET_ARRAY_BUFFER, normalized);
  }
  /// A VEC3 of places, whose box glTF wants to know.
  int positions(std::span<const sim::Vec3f> data);
  /// A number each.
  int numbers(std::span<const float> data) {
    return vertices(data, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR);
  }
  /// Unit ones.
  int normals(std::span<const sim::Vec3f> data) {
    return vertices(data, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
  }
  /// Those of ours count v upwards, those of glTF from the top. Those of blades are in 16 bits each where all
  /// lie within 0..1, and in the file once.
  int uvs(std::span<const glm::vec2> data, bool blades = false);
  /// One for each instance of a mesh.
  template <class T>
  int instances(std::span<const T> data, int component_type, int type, bool normalized = false) {
    return accessor(data.data(), data.size_bytes(), data.size(), component_type, type, 0, normalized);
  }
  /// In 16 bits each where there are no more than kMostShort vertices. `repeat`: they are in the file
  /// once where others go on as they do.
  int indices(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices,
              bool repeat = false);
  /// Readers that do not know an extension that is required refuse the file.
  void require(const std::string& extension);
  /// Readers that do not know one that is used show the rest.
  void use(const std::string& extension);
  /// Adds a buffer view of bytes as they are.
  int bytes(std::string_view data);
  /// Adds a node; without a mesh: -1.
  int node(const std::string& name, int mesh);

  tinygltf::Model& model() { return model_; }
  /// Puts the last of it into the buffer, and fills that up to whole words.
  void finish();
  std::size_t bufferBytes() const { return bytes_; }
  std::string json() const;

 private:
  void align();
  void put(const void* data, std::size_t bytes, tinygltf::BufferView& view);
  int view(const void* data, std::size_t bytes, int target);
  /// One for all data of which one begins as the other does; it comes into the buffer in the end.
  int repeatedView(const void* data, std::size_t bytes, int target);
  int accessor(const void* data, std::size_t bytes, std::size_t count, int component_type, int type,
               int target, bool normalized, bool repeat = false);

  struct Repeated {
    int view = 0;
    std::string bytes;
  };

  std::ostream& buffer_;
  std::size_t bytes_ = 0;           // of the buffer
  std::vector<Repeated> repeated_;  // none of which begins as another one does, where they are of one kind
  tinygltf::Model model_;
};

/// Writes a file whose parts `add_all` adds, from where the stream is on; what stands in front of the data is
/// known only after them, so the stream must be one that can be sought in and read back. Throws InputError
/// where the file would have 4 GB or more.
void writeGlbFile(std::iostream& file, const sim::Provenance& made_by,
                  const std::function<void(GlbFile&)>& add_all);

/// Of a VEC3 of places glTF wants to know the box.
void setExtent(tinygltf::Accessor& accessor, std::span<const sim::Vec3f> places);

/// UVs as glTF counts them.
std::vector<glm::vec2> turnedUvs(std::span<const glm::vec2> uvs);

inline int sizeOf(const auto& container) {
  return static_cast<int>(container.size());
}

/// Names come from other people's files; JSON takes valid UTF-8 only.
std::string validUtf8(const std::string& name);

}  // namespace espalier::render
