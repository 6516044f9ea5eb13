#include "docs/figures/figures.h"
#include "render/image/drawing.h"
#include "render/model/drawn_leaf.h"
#include "render/voxels/pale_scene.h"
#include "rules/language/colour.h"

namespace espalier::figures {
namespace {

constexpr int kCell = 300, kLabel = 44;

/// A leaf's picture over what is there, its upper left corner at (x, y).
void layOver(render::Image& image, const render::LeafPicture& leaf, int x, int y) {
  for (int j = 0; j < leaf.height; ++j) {
    for (int i = 0; i < leaf.width; ++i) {
      const auto& texel = leaf.texels[static_cast<std::size_t>(j * leaf.width + i)];
      const float alpha = static_cast<float>(texel[3]) / 255.0f;
      float* const pixel = image.at(x + i, y + j);
      for (std::size_t c = 0; c < 3; ++c)
        pixel[c] += alpha * (static_cast<float>(texel[c]) / 255.0f - pixel[c]);
    }
  }
}

}  // namespace

render::Image leaves() {
  const auto& kinds = render::drawnKinds();
  render::Image image = render::paper(kCell * static_cast<int>(kinds.size()), kCell + kLabel);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const sim::Colour colour =
        kinds[k] == "blossom" ? sim::Colour(0.95f, 0.77f, 0.82f) : sim::Colour(0.30f, 0.48f, 0.18f);
    const auto leaf = render::drawnLeaf(kinds[k], rules::linearFromSrgb(colour));
    const int left = kCell * static_cast<int>(k);
    layOver(image, *leaf, left + (kCell - leaf->width) / 2, kCell - leaf->height - 10);
    text(image, {static_cast<float>(left) + 0.5f * kCell, kCell + 24.0f}, kinds[k], 20.0f,
         render::Align::centre);
  }
  return image;
}

}  // namespace espalier::figures
