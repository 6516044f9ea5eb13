#include "render/finish/picture_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/image/drawing.h"
#include "sim/base/srgb.h"

namespace espalier::render {
namespace {

/// The four texels about a place, and their weights.
struct Between {
  std::array<std::size_t, 4> texel;
  std::array<float, 4> weight;
};

using Wrap = sim::Texture::Wrap;

Between between(glm::vec2 uv, int width, int height, const PictureTexture::Wraps& wraps) {
  const auto axis = [](float at, int size, Wrap wrap) {
    const bool tiles = wrap == Wrap::repeat;
    if (wrap == Wrap::mirror) at = 1.0f - std::abs(at - 2.0f * std::floor(0.5f * at) - 1.0f);
    const float whole = tiles ? at - std::floor(at) : std::clamp(at, 0.0f, 1.0f);
    const float place = whole * static_cast<float>(size) - 0.5f;
    const float low = std::floor(place);
    const auto index = [&](float i) {
      const int texel = static_cast<int>(i);
      return static_cast<std::size_t>(tiles ? (texel + size) % size : std::clamp(texel, 0, size - 1));
    };
    return std::tuple(index(low), index(low + 1.0f), place - low);
  };
  const auto [x0, x1, fx] = axis(uv.x, width, wraps[0]);
  const auto [y0, y1, fy] = axis(1.0f - uv.y, height, wraps[1]);
  const auto row = static_cast<std::size_t>(width);
  return {{y0 * row + x0, y0 * row + x1, y1 * row + x0, y1 * row + x1},
          {(1.0f - fx) * (1.0f - fy), fx * (1.0f - fy), (1.0f - fx) * fy, fx * fy}};
}

}  // namespace

PictureTexture::PictureTexture(const LeafPicture& picture)
    : PictureTexture(picture,
                     picture.tiles ? Wraps{Wrap::repeat, Wrap::repeat} : Wraps{Wrap::clamp, Wrap::clamp},
                     std::max(picture.width, picture.height)) {}

PictureTexture::PictureTexture(const LeafPicture& picture, const Wraps& wraps, int most_side)
    : wraps_(wraps) {
  std::array<float, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = sim::linearFromSrgb(static_cast<float>(i) / 255.0f);
  Image image(picture.width, picture.height, 4);  // linear, premultiplied: so that it may be reduced
  sim::Colour mean(0.0f);
  float covered = 1e-6f;
  for (std::size_t i = 0; i < picture.texels.size(); ++i) {
    const auto& texel = picture.texels[i];
    const float alpha = static_cast<float>(texel[3]) / 255.0f;
    const sim::Colour colour = alpha * sim::Colour(linear[texel[0]], linear[texel[1]], linear[texel[2]]);
    std::copy_n(&colour.r, 3, image.pixels.data() + 4 * i);
    image.pixels[4 * i + 3] = alpha;
    mean += colour;
    covered += alpha;
  }
  mean /= covered;
  while (std::max(image.width, image.height) > most_side)
    image = resized(image, std::max(image.width / 2, 1), std::max(image.height / 2, 1));
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) alpha_.push_back(image.pixels[i]);
  for (;;) {
    Level level{image.width, image.height, {}};
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
      const float* const p = image.pixels.data() + i;
      level.colours.push_back(p[3] > 1e-3f ? sim::Colour(p[0], p[1], p[2]) / p[3] : mean);
    }
    levels_.push_back(std::move(level));
    if (image.width <= 2 || image.height <= 2) break;
    image = resized(image, image.width / 2, image.height / 2);
  }
}

bool PictureTexture::covers(glm::vec2 uv) const {
  const Between b = between(uv, levels_.front().width, levels_.front().height, wraps_);
  float alpha = 0.0f;
  for (std::size_t i = 0; i < 4; ++i) alpha += b.weight[i] * alpha_[b.texel[i]];
  return alpha >= kCutout;
}

sim::Colour PictureTexture::colour(glm::vec2 uv, float span) const {
  const float texels = span * static_cast<float>(levels_.front().height);
  const int wanted = texels > 1.0f ? static_cast<int>(std::lround(std::log2(texels))) : 0;
  const Level& level =
      levels_[static_cast<std::size_t>(std::min(wanted, static_cast<int>(levels_.size()) - 1))];
  const Between b = between(uv, level.width, level.height, wraps_);
  sim::Colour colour(0.0f);
  for (std::size_t i = 0; i < 4; ++i) colour += b.weight[i] * level.colours[b.texel[i]];
  return colour;
}

}  // namespace espalier::render
