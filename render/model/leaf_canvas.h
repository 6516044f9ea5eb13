#pragma once
#include <functional>
#include <vector>

#include <glm/vec2.hpp>

#include "render/image/drawing.h"
#include "render/image/image.h"
#include "render/model/leaf_picture.h"

namespace espalier::render {

/// What leaves are drawn on: a plane as high as 1 and as wide as told, x from its middle, y upwards. Where
/// nothing is laid it is transparent; colours are display values.
class LeafCanvas {
 public:
  LeafCanvas(float width, sim::Colour ground);

  using HalfWidth = std::function<float(float t)>;
  /// A band about a curve, wide by half_width(t), t from 0 where it begins to 1: its left and its right half
  /// each in a colour.
  void band(const std::vector<glm::vec2>& curve, const HalfWidth& half_width, sim::Colour left,
            sim::Colour right);
  /// A line on what is laid already, from one width to another.
  void vein(const std::vector<glm::vec2>& curve, float from_width, float to_width, Ink ink);

  LeafPicture picture(const std::string& name) const;

 private:
  glm::vec2 pixel(glm::vec2 at) const;
  void quad(Image& image, const std::array<glm::vec2, 4>& corners, Ink ink) const;

  float width_;
  Image colour_, mask_;
};

/// Points of a quadratic Bezier curve, evenly in its parameter.
std::vector<glm::vec2> bentLine(glm::vec2 from, glm::vec2 by, glm::vec2 to, int pieces = 16);

}  // namespace espalier::render
