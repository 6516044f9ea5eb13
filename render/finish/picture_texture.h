#pragma once
#include <array>
#include <vector>

#include <glm/vec2.hpp>

#include "render/image/image.h"
#include "render/model/leaf_picture.h"
#include "sim/base/vec.h"
#include "sim/tile/mesh.h"

namespace espalier::render {

/// A picture made ready to be looked at from near and far. UVs as in LeafPicture; beyond 0..1 it tiles, or
/// its rim goes on, or it goes back. Several threads may ask.
class PictureTexture {
 public:
  using Wraps = std::array<sim::Texture::Wrap, 2>;

  /// Tiles both ways, or not.
  explicit PictureTexture(const LeafPicture& picture);
  /// `most_side`: of its texels; a larger one is halved until it has no more.
  PictureTexture(const LeafPicture& picture, const Wraps& wraps, int most_side);

  /// Whether there is anything of the blade at a place.
  bool covers(glm::vec2 uv) const;
  /// Linear colour where a pixel spans that much of the picture's height.
  sim::Colour colour(glm::vec2 uv, float span) const;

 private:
  struct Level {
    int width = 0, height = 0;
    std::vector<sim::Colour> colours;  // linear, of what covers alone
  };
  Wraps wraps_;
  std::vector<Level> levels_;  // each half as large as the one before
  std::vector<float> alpha_;   // of the first
};

}  // namespace espalier::render
