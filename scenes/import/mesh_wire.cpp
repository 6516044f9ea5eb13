#include "scenes/import/mesh_wire.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace espalier::scenes {
namespace {

class Packer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void putArray(const T* data, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(static_cast<std::uint64_t>(count));
    bytes_.append(reinterpret_cast<const char*>(data), count * sizeof(T));
  }
  void putText(const std::string& text) { putArray(text.data(), text.size()); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T get() {
    T value{};
    const std::string_view raw = take(sizeof value);
    std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }
  template <class T>
  std::vector<T> getArray() {
    const auto count = getCount(sizeof(T));
    const std::string_view raw = take(count * sizeof(T));
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), raw.data(), raw.size());
    return values;
  }
  std::string getText() { return std::string(take(getCount(1))); }
  /// A count of things that take at least `each` bytes.
  std::size_t getCount(std::size_t each) {
    const auto count = get<std::uint64_t>();
    if (count > bytes_.size() / each) throw std::runtime_error("a count is larger than what follows it");
    return static_cast<std::size_t>(count);
  }
  bool atEnd() const { return bytes_.empty(); }

 private:
  std::string_view take(std::size_t count) {
    if (count > bytes_.size()) throw std::runtime_error("the bytes end early");
    const auto taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }

  std::string_view bytes_;
};

void requireBelow(const std::vector<std::uint32_t>& indices, std::size_t limit) {
  if (std::any_of(indices.begin(), indices.end(), [&](std::uint32_t i) { return i >= limit; })) {
    throw std::runtime_error("an index is out of range");
  }
}

}  // namespace

std::string packMesh(const sim::Mesh& mesh, const MeshSources& sources) {
  Packer out;
  out.putText(mesh.name);
  out.putArray(mesh.vertices_m.data(), mesh.vertices_m.size());
  out.putArray(mesh.triangles.data(), mesh.triangles.size());
  out.putArray(mesh.region.data(), mesh.region.size());
  out.putArray(mesh.material.data(), mesh.material.size());
  out.put(static_cast<std::uint64_t>(mesh.regions.size()));
  for (const auto& name : mesh.regions) out.putText(name);
  out.put(static_cast<std::uint64_t>(mesh.materials.size()));
  for (const auto& material : mesh.materials) {
    out.putText(material.name);
    out.put(material.colour);
  }
  out.put(static_cast<std::uint64_t>(mesh.degenerate_dropped));
  out.put(static_cast<std::uint64_t>(sources.files.size()));
  for (const auto& file : sources.files) {
    out.putText(file.name);
    out.putText(file.kind);
    out.put(file.hash);
  }
  out.put(static_cast<std::uint64_t>(sources.warnings.size()));
  for (const auto& warning : sources.warnings) {
    out.put(warning.line);
    out.put(warning.column);
    out.putText(warning.text);
  }
  return out.take();
}

sim::Mesh unpackMesh(std::string_view bytes, MeshSources& sources) {
  Unpacker in(bytes);
  sim::Mesh mesh;
  mesh.name = in.getText();
  mesh.vertices_m = in.getArray<sim::Vec3>();
  mesh.triangles = in.getArray<std::array<std::uint32_t, 3>>();
  mesh.region = in.getArray<std::uint32_t>();
  mesh.material = in.getArray<std::uint32_t>();
  mesh.regions.resize(in.getCount(sizeof(std::uint64_t)));
  for (auto& name : mesh.regions) name = in.getText();
  mesh.materials.resize(in.getCount(sizeof(std::uint64_t) + sizeof(sim::Colour)));
  for (auto& material : mesh.materials) {
    material.name = in.getText();
    material.colour = in.get<sim::Colour>();
  }
  mesh.degenerate_dropped = static_cast<std::size_t>(in.get<std::uint64_t>());
  sources.files.resize(in.getCount(3 * sizeof(std::uint64_t)));
  for (auto& file : sources.files) {
    file.name = in.getText();
    file.kind = in.getText();
    file.hash = in.get<std::uint64_t>();
  }
  sources.warnings.resize(in.getCount(2 * sizeof(int) + sizeof(std::uint64_t)));
  for (auto& warning : sources.warnings) {
    warning.line = in.get<int>();
    warning.column = in.get<int>();
    warning.text = in.getText();
  }
  if (!in.atEnd()) throw std::runtime_error("there are bytes after the end");
  if (mesh.region.size() != mesh.triangles.size() || mesh.material.size() != mesh.triangles.size()) {
    throw std::runtime_error("not every triangle has a region and a material");
  }
  requireBelow(mesh.region, mesh.regions.size());
  requireBelow(mesh.material, mesh.materials.size());
  return mesh;
}

}  // namespace espalier::scenes
