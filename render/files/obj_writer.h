#pragma once
// Internal to the wing.
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <iterator>
#include <ostream>
#include <span>
#include <string>

#include "render/files/obj_materials.h"
#include "sim/base/provenance.h"
#include "sim/base/vec.h"

namespace espalier::render {

/// A comment: what made the file.
std::string objFirstLine(const sim::Provenance& made_by);

/// Writes surfaces one after the other; OBJ numbers corners through the whole file.
class ObjWriter {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  explicit ObjWriter(std::ostream& file) : file_(file) {}

  void begin(const char* keyword, const std::string& name) { put("{} {}\n", keyword, objName(name)); }
  /// Uvs and normals: of each vertex, or empty.
  template <class Positions>
  void add(const std::string& material, const Positions& positions, std::span<const glm::vec2> uvs,
           std::span<const sim::Vec3f> normals, std::span<const Triangle> triangles) {
    for (const auto& p : positions) put("v {} {} {}\n", p.x, p.y, p.z);
    for (const glm::vec2 uv : uvs) put("vt {:.5g} {:.5g}\n", uv.x, uv.y);
    for (const sim::Vec3f n : normals) put("vn {:.4g} {:.4g} {:.4g}\n", n.x, n.y, n.z);
    put("usemtl {}\n", material);
    addFaces(triangles, uvs, normals);
    vertices_ += std::size(positions);
    uvs_ += uvs.size();
    normals_ += normals.size();
  }
  /// Colours: of each vertex, display values.
  void add(std::span<const sim::Vec3f> positions, std::span<const sim::Colour> colours,
           std::span<const Triangle> triangles) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const auto &p = positions[i], &c = colours[i];
      put("v {} {} {} {:.4g} {:.4g} {:.4g}\n", p.x, p.y, p.z, c.r, c.g, c.b);
    }
    addFaces(triangles, {}, {});
    vertices_ += positions.size();
  }
  void finish() {
    file_ << text_;
    text_.clear();
  }

 private:
  void addFaces(std::span<const Triangle> triangles, std::span<const glm::vec2> uvs,
                std::span<const sim::Vec3f> normals) {
    for (const Triangle& triangle : triangles) {
      text_ += 'f';
      for (const std::uint32_t corner : triangle) {
        fmt::format_to(std::back_inserter(text_), " {}", vertices_ + corner);
        if (!uvs.empty() || !normals.empty()) text_ += '/';
        if (!uvs.empty()) fmt::format_to(std::back_inserter(text_), "{}", uvs_ + corner);
        if (!normals.empty()) fmt::format_to(std::back_inserter(text_), "/{}", normals_ + corner);
      }
      put("\n");
    }
  }
  template <class... Values>
  void put(fmt::format_string<const Values&...> format, const Values&... values) {
    fmt::format_to(std::back_inserter(text_), format, values...);
    constexpr std::size_t kAtOnce = 1 << 16;
    if (text_.size() > kAtOnce) finish();
  }

  std::ostream& file_;
  std::string text_;
  std::size_t vertices_ = 1, uvs_ = 1, normals_ = 1;
};

}  // namespace espalier::render
