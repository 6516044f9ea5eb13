#pragma once
#include <span>
#include <string>

#include "render/image/image.h"

namespace espalier::render {

struct Captioned {
  const Image* picture;  ///< display values, RGB
  std::string letter;    ///< "A"; may be empty
  std::string caption;   ///< "sun_exposure"
};

struct SheetLook {
  int columns = 3;
  int picture_width_px = 480;
  std::string title;      ///< may be empty
  std::string note = {};  ///< below the title, quieter: what the pictures' numbers are; lines by \n
};

/// A picture as a sheet shows it. A sheet of pictures that were reduced before is the same.
Image reducedForSheet(const Image& picture, int width_px);

/// Reduced pictures in rows on a quiet ground, each with its caption beneath; display values. Those of other
/// shapes stand in the middle of cells as high as the tallest, or as the first or a square if that is taller
/// still. Throws InputError if there are none.
Image contactSheet(std::span<const Captioned> pictures, const SheetLook& look = {});

}  // namespace espalier::render
