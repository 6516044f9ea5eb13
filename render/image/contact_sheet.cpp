#include "render/image/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/image/drawing.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"

namespace espalier::render {
namespace {

constexpr sim::Colour kGround(0.965f, 0.957f, 0.94f);
constexpr Ink kTitle{sim::Colour(0.13f, 0.13f, 0.14f), 1.0f};
constexpr Ink kCaption{sim::Colour(0.24f, 0.24f, 0.25f), 1.0f};
constexpr Ink kLetter{sim::Colour(0.62f, 0.29f, 0.17f), 1.0f};

}  // namespace

Image reducedForSheet(const Image& picture, int width_px) {
  const double height_px = static_cast<double>(width_px) * picture.height / picture.width;
  return resized(picture, width_px, std::max(1, static_cast<int>(std::lround(height_px))));
}

Image contactSheet(std::span<const Captioned> pictures, const SheetLook& look) {
  if (pictures.empty() || look.columns < 1 || look.picture_width_px < 1)
    throw sim::InputError("a contact sheet needs at least one picture, one column and one pixel");
  for (const Captioned& p : pictures) {
    if (p.picture->channels != 3)
      throw sim::InputError("the pictures of a contact sheet must have three channels");
  }
  const int width = look.picture_width_px;
  std::vector<Image> reduced(pictures.size());
  sim::parallelForEach(pictures.size(),
                       [&](std::size_t i) { reduced[i] = reducedForSheet(*pictures[i].picture, width); });
  // Of a cell: as the tallest needs it; a tower among wide pictures becomes narrower instead.
  int height = 0;
  for (const Image& picture : reduced) height = std::max(height, picture.height);
  height = std::min(height, std::max(width, reduced.front().height));
  for (Image& picture : reduced) {
    if (picture.height > height)
      picture = resized(picture, std::max(1, picture.width * height / picture.height), height);
  }
  const float text = std::max(9.0f, static_cast<float>(width) / 28.0f);
  const int gutter = static_cast<int>(std::lround(1.5f * text));
  const int caption = static_cast<int>(std::lround(2.0f * text));
  const auto notes = linesOf(look.note);
  const float line = 1.25f * text;  // of the notes
  const int head = static_cast<int>(
      std::lround((look.title.empty() ? 0.0f : 3.0f * text) + line * static_cast<float>(notes.size())));
  const int count = static_cast<int>(pictures.size());
  const int columns = std::min(look.columns, count), rows = (count + columns - 1) / columns;

  Image sheet(gutter + columns * (width + gutter),
              head + gutter + rows * (height + caption) + (rows - 1) * gutter / 2 + gutter / 2, 3);
  fillBox(sheet, {0, 0}, {static_cast<float>(sheet.width), static_cast<float>(sheet.height)},
          {kGround, 1.0f});
  glm::vec2 top(static_cast<float>(gutter), static_cast<float>(gutter) + 1.2f * text);
  if (!look.title.empty()) {
    drawText(sheet, top, look.title, {1.35f * text, kTitle, Align::left, Font::bold});
    top.y += 1.6f * text;
  }
  for (const std::string& note : notes) {
    drawText(sheet, top, note, {0.85f * text, kCaption});
    top.y += line;
  }
  for (int i = 0; i < count; ++i) {
    const Captioned& p = pictures[static_cast<std::size_t>(i)];
    const int x = gutter + (i % columns) * (width + gutter);
    const int y = head + gutter + (i / columns) * (height + caption + gutter / 2);
    const Image& picture = reduced[static_cast<std::size_t>(i)];
    paste(sheet, picture, x + (width - picture.width) / 2, y + (height - picture.height) / 2);
    glm::vec2 pen(static_cast<float>(x), static_cast<float>(y + height) + 1.4f * text);
    if (!p.letter.empty()) {
      drawText(sheet, pen, p.letter, {text, kLetter, Align::left, Font::bold});
      pen.x += std::max(1.5f * text, textWidth(p.letter, text, Font::bold) + 0.6f * text);
    }
    drawText(sheet, pen, p.caption, {text, kCaption});
  }
  return sheet;
}

}  // namespace espalier::render
