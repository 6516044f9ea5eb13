#pragma once
#include <string>

#include "render/image/drawing.h"

/// The figures of the documents that no scene draws, and what they share.
namespace espalier::figures {

inline constexpr sim::Colour kPaper(0.985f, 0.98f, 0.97f), kInk(0.13f, 0.14f, 0.16f);

inline void text(render::Image& image, glm::vec2 at, const std::string& words, float size,
                 render::Align align = render::Align::left, render::Font font = render::Font::regular,
                 sim::Colour colour = kInk) {
  render::drawText(image, at, words, {size, {colour}, align, font});
}

/// Of docs/house.md: rooms and wings.
render::Image house();
/// Of docs/lattice-sweep.md.
render::Image latticeSweep();
/// Of docs/trees.md: the leaves that the program draws.
render::Image leaves();
/// Of docs/house.md: its example.
render::Image moss();

}  // namespace espalier::figures
