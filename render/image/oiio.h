#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/image/image_io.h"
#include "sim/base/vec.h"

/// What OpenImageIO does for us, as functions of a module that is loaded when they are first asked for.
/// OpenImageIO brings two hundred and forty libraries along, whose loading takes five times as long as that
/// of all others together: a program that starts with them makes every `check` wait, and every process of a
/// test.
namespace espalier::render {

/// In pixels from where a text begins on its base line, y downwards.
struct TextBox {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// A picture as it was read: sRGB and alpha that is not premultiplied, rows from the top.
struct Texels {
  std::int32_t width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 4>> rgba;
};

/// All throw sim::InputError where OpenImageIO fails.
struct Oiio {
  /// `size`: of the picture, whose own pixels are not read.
  std::string (*png)(const Image& size, const std::uint8_t* pixels, const Metadata& texts);
  std::string (*exr)(const Image& measured, const std::vector<std::string>& channels, const Metadata& texts);
  /// The first picture of a PNG's bytes; grey becomes three channels alike, and no alpha is opaque. Its size
  /// is judged before any pixel is read. On the calling thread alone.
  Texels (*read_png)(const std::string& bytes, int most_pixels, int most_side);
  /// The same of a JPEG's.
  Texels (*read_jpeg)(const std::string& bytes, int most_pixels, int most_side);
  /// The first picture of an EXR, HDR, PNG or JPEG file by its first one or three channels, rows from the
  /// top; `display` where its values are display values (sRGB), and not linear. Its size is judged before any
  /// pixel is read: it must be twice as wide as high. On the calling thread alone, and for a process of its
  /// own: what it sets for OpenEXR stays set.
  Image (*read_panorama)(const std::string& path, int most_pixels, bool& display);
  /// The first picture of such a file as one channel, rows from the top: the values that the file has,
  /// whether linear or not; of colours their luminance by Rec. 709, and where it has alpha times that. Beyond
  /// the data window of an EXR it is 0. Its size is judged before any pixel is read. As read_panorama
  /// otherwise.
  Image (*read_luminance)(const std::string& path, int most_pixels, int most_side);
  /// Nothing where the font is not installed.
  std::optional<TextBox> (*text_box)(const std::string& ascii, int size_px, const char* font);
  /// Draws white letters into a picture of one channel.
  void (*text)(Image& onto, int x, int y, const std::string& ascii, int size_px, const char* font);
  void (*paste)(Image& onto, const Image& picture, int x, int y);
  /// Fills a picture of another size and as many channels.
  void (*resize)(const Image& from, Image& to);
  /// Linear colours at equal steps from 0 to 1.
  std::vector<sim::Colour> (*colour_map)(const std::string& name, int entries);
};

/// Loads it. Throws sim::InputError where the module, or a library that it needs, is missing.
const Oiio& oiio();

}  // namespace espalier::render
