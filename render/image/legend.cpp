#include "render/image/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/image/drawing.h"
#include "render/image/tone.h"

namespace espalier::render {
namespace {

constexpr Ink kPlate{sim::Colour(0.985f, 0.98f, 0.97f), 0.86f};
constexpr Ink kPlateEdge{sim::Colour(0.1f, 0.1f, 0.12f), 0.10f};
constexpr Ink kStrong{sim::Colour(0.13f, 0.14f, 0.16f), 1.0f};
constexpr Ink kQuiet{sim::Colour(0.13f, 0.14f, 0.16f), 0.66f};

/// All measures follow from the size of the text, which follows from the picture.
struct Layout {
  explicit Layout(const Image& image)
      : text(std::max(9.0f, static_cast<float>(std::min(image.width, image.height)) / 46.0f)),
        note(0.8f * text),
        pad(0.95f * text),
        margin(1.3f * text) {}
  float text, note, pad, margin;
};

float widestLine(const std::string& title, const std::string& note, const Layout& is) {
  float width = textWidth(title, is.text, Font::bold);
  for (const std::string& line : linesOf(note)) width = std::max(width, textWidth(line, is.note));
  return width;
}

/// Draws the plate, the title and the note; gives back where the content's upper left corner is.
glm::vec2 drawPlate(Image& image, const Layout& is, glm::vec2 content, const std::string& title,
                    const std::string& note) {
  const auto notes = linesOf(note);
  const float head =
      (title.empty() ? 0.0f : 1.35f * is.text) + 1.35f * is.note * static_cast<float>(notes.size());
  const float gap = head > 0.0f ? 0.45f * is.text : 0.0f;
  const float width = std::max(content.x, widestLine(title, note, is));
  const glm::vec2 size(width + 2 * is.pad, content.y + head + gap + 2 * is.pad);
  const glm::vec2 low =
      glm::floor(glm::vec2(is.margin, static_cast<float>(image.height) - is.margin - size.y));
  const float radius = 0.4f * is.text;
  fillBox(image, low - 1.0f, low + size + 1.0f, kPlateEdge, radius + 1.0f);
  fillBox(image, low, low + size, kPlate, radius);
  glm::vec2 pen = low + is.pad;
  if (!title.empty()) {
    drawText(image, {pen.x, pen.y + 0.95f * is.text}, title, {is.text, kStrong, Align::left, Font::bold});
    pen.y += 1.35f * is.text;
  }
  for (const std::string& line : notes) {
    drawText(image, {pen.x, pen.y + 0.95f * is.note}, line, {is.note, kQuiet});
    pen.y += 1.35f * is.note;
  }
  return {pen.x, pen.y + gap};
}

}  // namespace

void drawLegend(Image& image, const BarLegend& legend, const ColourMap& colours) {
  const Layout is(image);
  const float bar_width = std::round(std::max(widestLine(legend.title, legend.note, is), 15.0f * is.text));
  const float bar_height = std::round(0.85f * is.text);
  const float tick = 0.3f * is.text;
  const glm::vec2 content(bar_width, bar_height + tick + 1.35f * is.note);
  const glm::vec2 corner = drawPlate(image, is, content, legend.title, legend.note);

  const glm::vec2 low = glm::round(corner);
  fillBox(image, low - 1.0f, low + glm::vec2(bar_width, bar_height) + 1.0f, {kStrong.colour, 0.55f});
  for (float x = 0.0f; x < bar_width; x += 1.0f) {
    const sim::Colour colour = srgbFromLinear(colours((x + 0.5f) / bar_width));
    fillBox(image, low + glm::vec2(x, 0.0f), low + glm::vec2(x + 1.0f, bar_height), {colour, 1.0f});
  }
  for (int i = 0; static_cast<float>(i) * legend.step < 1.0005f * legend.most; ++i) {
    const float value = static_cast<float>(i) * legend.step;
    const float x = low.x + value / legend.most * bar_width;
    const float top = low.y + bar_height + 1.0f;
    drawSegment(image, {x, top}, {x, top + tick}, std::max(1.0f, 0.07f * is.text), kQuiet);
    drawText(image, {x, top + tick + 1.1f * is.note}, fmt::format("{:g}", value),
             {is.note, kStrong, Align::centre});
  }
}

void drawLegend(Image& image, const SwatchLegend& legend) {
  const Layout is(image);
  const float side = std::round(1.05f * is.text), line = 1.55f * is.text;
  float width = 0.0f;
  for (const Swatch& swatch : legend.swatches)
    width = std::max(width, side + 0.55f * is.text + textWidth(swatch.label, is.note));
  const float count = static_cast<float>(legend.swatches.size());
  glm::vec2 pen = drawPlate(image, is, {width, line * count - (line - side)}, legend.title, legend.note);
  pen = glm::round(pen);
  for (const Swatch& swatch : legend.swatches) {
    fillBox(image, pen - 1.0f, pen + side + 1.0f, {kStrong.colour, 0.45f}, 0.15f * side);
    fillBox(image, pen, pen + side, {swatch.colour, 1.0f}, 0.12f * side);
    drawText(image, {pen.x + side + 0.55f * is.text, pen.y + 0.5f * side + 0.36f * is.note}, swatch.label,
             {is.note, kStrong});
    pen.y += line;
  }
}

}  // namespace espalier::render
