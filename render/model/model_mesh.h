#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "render/model/leaf_picture.h"
#include "sim/base/vec.h"

namespace espalier::render {

/// A surface ready to be drawn or written out, in world metres. All per-vertex arrays have one length.
/// Triangles are counter-clockwise seen from the side to which the normals point.
struct ModelMesh {
  std::string name;
  sim::Colour base_colour{0.5f};  ///< linear RGB
  sim::Colour emits{0.0f};        ///< light of its own, linear RGB
  float emits_share = 1.0f;       ///< what of it is left with each of its orders
  float alpha = 1.0f;             ///< how much it hides of what is behind it, 0..1
  /// Laid on it by its UVs in place of the base colour; null: none.
  std::shared_ptr<const LeafPicture> picture;
  bool body = false;  ///< closed, as stones are: neither veined nor seen through
  std::vector<sim::Vec3f> positions_m;
  std::vector<sim::Vec3f> normals;  ///< unit
  std::vector<glm::vec2> uvs;
  std::vector<sim::Colour> tints;     ///< by what the colour is multiplied; empty: by nothing
  std::vector<float> exposures;       ///< 0..1, as the plant sensed it where it grew
  std::vector<float> youths;          ///< 0 for what the first iteration placed .. 1 for the last
  std::vector<std::uint8_t> orders;   ///< of branching: 0 trunks, 1 what leaves them, .. 255 and above
  std::vector<std::uint32_t> pieces;  ///< number of the stem axis or of the placed element
  /// The point of the surface at each vertex: those of one point differ in their UVs alone. Empty: each is a
  /// point of its own.
  std::vector<std::uint32_t> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  bool empty() const { return triangles.empty(); }
};

}  // namespace espalier::render
