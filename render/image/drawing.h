#pragma once
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "render/image/image.h"
#include "sim/base/vec.h"

/// Text, lines and boxes over pictures of display values with three channels. Places are in pixels from the
/// upper left corner of the picture, (0.5, 0.5) being the middle of its first pixel. Everything is
/// anti-aliased, and what falls outside the picture is cut off.
namespace espalier::render {

struct Ink {
  sim::Colour colour{0.0f};  ///< display values
  float opacity = 1.0f;
};

/// Around lines that pass over others, so that they are told apart.
inline constexpr sim::Colour kRim(0.99f, 0.985f, 0.975f);
/// The opacity of what something stands before.
inline constexpr float kHidden = 0.10f;

enum class Align { left, centre, right };
enum class Font { regular, bold };

struct TextStyle {
  float size_px = 16.0f;
  Ink ink;
  Align align = Align::left;
  Font font = Font::regular;
};

/// Texts are in ASCII; any other character is drawn as a question mark. Throws InputError where the font
/// (DejaVu Sans) is not installed.
float textWidth(const std::string& text, float size_px, Font font = Font::regular);
/// `at` is on the base line: the left end, the middle or the right end of the text by its alignment.
void drawText(Image& image, glm::vec2 at, const std::string& text, const TextStyle& style);

std::vector<std::string> linesOf(const std::string& text);

void drawSegment(Image& image, glm::vec2 a, glm::vec2 b, float width_px, Ink ink);
void fillTriangle(Image& image, glm::vec2 a, glm::vec2 b, glm::vec2 c, Ink ink);
/// A convex polygon of any number of corners, without seams inside; one without area leaves no trace.
void fillConvex(Image& image, std::span<const glm::vec2> corners, Ink ink);
void fillBox(Image& image, glm::vec2 low, glm::vec2 high, Ink ink, float corner_radius_px = 0.0f);

/// Copies a picture onto another one with its upper left corner at (x, y).
void paste(Image& onto, const Image& picture, int x, int y);
/// A copy of another size, well filtered.
Image resized(const Image& image, int width_px, int height_px);

}  // namespace espalier::render
