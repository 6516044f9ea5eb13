#include "render/voxels/pale_scene.h"

#include <algorithm>

#include "render/image/drawing.h"
#include "render/voxels/near_faces.h"
#include "sim/base/parallel.h"

namespace espalier::render {
namespace {

constexpr sim::Colour kPale(0.985f, 0.98f, 0.97f);
/// Display values of a face of no relief and of full relief.
constexpr sim::Colour kDeep(0.70f, 0.71f, 0.715f), kBright(0.925f, 0.925f, 0.92f);

}  // namespace

Image paper(int width_px, int height_px) {
  Image image(width_px, height_px, 3);
  fillBox(image, {0, 0}, {static_cast<float>(width_px), static_cast<float>(height_px)}, {kPale, 1.0f});
  return image;
}

Image paleScene(const Visibility& seen, const sim::BitVolume& occupied) {
  Image image(seen.width, seen.height, 3);
  sim::parallelForEach(static_cast<std::size_t>(seen.height), [&](std::size_t row) {
    NearFaces near(occupied);
    for (int x = 0; x < seen.width; ++x) {
      const std::size_t pixel = row * static_cast<std::size_t>(seen.width) + static_cast<std::size_t>(x);
      sim::Colour sum(0.0f);
      float all = 0.0f;
      for (const Fragment& f : seen.pixel(pixel)) {
        const float weight = static_cast<float>(f.samples);
        all += weight;
        if (f.face != kSky) near.goTo(f);
        sum +=
            weight * (f.face == kSky ? kPale : glm::mix(kDeep, kBright, std::min(near.relief(f.at), 1.0f)));
      }
      const sim::Colour mean = sum / all;
      std::copy_n(&mean.r, 3, image.at(x, static_cast<int>(row)));
    }
  });
  return image;
}

}  // namespace espalier::render
