#pragma once
#include <array>
#include <span>

#include <glm/vec2.hpp>

#include "render/image/image.h"
#include "sim/base/vec.h"

/// A flat body and the lines on it, cut out along its outline: a picture that can be laid on a card.
namespace espalier::render {

/// Of the body: corners in any unit, x to the right and y upwards, and a colour, linear.
struct CutOutTriangle {
  std::array<glm::vec2, 3> corners;
  sim::Colour colour{0.0f};
};

/// A line with round ends, the same unit and colours.
struct CutOutLine {
  glm::vec2 from{0.0f}, to{0.0f};
  float from_radius = 0.0f, to_radius = 0.0f;
  sim::Colour colour{0.0f};
};

/// Display values with alpha, which is not premultiplied: the share of a pixel that the body covers. As large
/// as it can be within so many pixels, and no larger than the body. Lines lie in furrows, with a darker rim;
/// the body is lighter along them and vaulted between them. What is transparent has the body's mean colour,
/// so that nothing shines through at the rims where the picture is made smaller. Throws InputError for a body
/// without area.
Image drawCutOut(std::span<const CutOutTriangle> body, std::span<const CutOutLine> lines, int most_width_px,
                 int most_height_px);

/// The same on paper, with three channels.
Image onPaper(const Image& cut_out);

}  // namespace espalier::render
