#include "render/model/drawn_bark.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>

#include "render/image/image_io.h"
#include "render/image/noise.h"
#include "render/image/tone.h"

namespace espalier::render {
namespace {

constexpr int kBarkSide = 256;
constexpr std::size_t kMostBarksKept = 64;

float smoothStep(float from, float to, float v) {
  const float t = std::clamp((v - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

/// How bright bark is at a place of a tile of 1 x 1, about 1 on the mean.
float barkAt(const Noise& noise, float u, float v) {
  const auto of = [&](int across, int along, float layer) {
    return noise.tiled({u * static_cast<float>(across), v * static_cast<float>(along), layer},
                       {across, along, 32});
  };
  const float bent = 0.9f * of(6, 4, 3.5f);
  // Furrows lie where a wavering field crosses zero.
  const float field = noise.tiled({u * 14.0f + bent, v * 4.0f, 7.3f}, {14, 4, 32}) + 0.35f * of(28, 9, 11.7f);
  const float furrow = 1.0f - smoothStep(0.0f, 0.26f, std::abs(field));
  const float crack = 1.0f - smoothStep(0.0f, 0.10f, std::abs(of(9, 14, 17.1f) + 0.3f * of(24, 30, 19.9f)));
  const float plate = 0.10f * of(12, 6, 23.3f) + 0.10f * of(32, 14, 27.7f);
  return 1.10f + plate - 0.46f * furrow - 0.16f * crack * (1.0f - furrow);
}

LeafPicture barkIn(sim::Colour display) {
  const Noise noise;
  LeafPicture bark;
  bark.name = "bark";
  bark.tiles = true;
  bark.width = bark.height = kBarkSide;
  Image image(kBarkSide, kBarkSide, 3);
  for (int y = 0; y < kBarkSide; ++y) {
    for (int x = 0; x < kBarkSide; ++x) {
      const float value = barkAt(noise, (static_cast<float>(x) + 0.5f) / kBarkSide,
                                 1.0f - (static_cast<float>(y) + 0.5f) / kBarkSide);
      std::array<std::uint8_t, 4> texel{0, 0, 0, 255};
      for (int c = 0; c < 3; ++c) {
        texel[static_cast<std::size_t>(c)] =
            static_cast<std::uint8_t>(std::lround(std::clamp(display[c] * value, 0.0f, 1.0f) * 255.0f));
        image.at(x, y)[c] = static_cast<float>(texel[static_cast<std::size_t>(c)]) / 255.0f;
      }
      bark.texels.push_back(texel);
    }
  }
  bark.png = encodePng(image);
  return bark;
}

}  // namespace

std::shared_ptr<const LeafPicture> drawnBark(sim::Colour colour) {
  static std::mutex one_at_a_time;
  static std::map<std::tuple<float, float, float>, std::shared_ptr<const LeafPicture>> drawn;
  const std::lock_guard lock(one_at_a_time);
  if (drawn.size() >= kMostBarksKept) drawn.clear();  // a server draws in many colours
  auto& picture = drawn[{colour.r, colour.g, colour.b}];
  if (!picture) picture = std::make_shared<const LeafPicture>(barkIn(srgbFromLinear(colour)));
  return picture;
}

}  // namespace espalier::render
