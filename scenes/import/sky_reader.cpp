#include "scenes/import/sky_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "render/image/oiio.h"
#include "scenes/clean_text.h"
#include "scenes/import/guarded_file.h"
#include "scenes/import/wire.h"
#include "sim/base/error.h"
#include "sim/base/hasher.h"
#include "sim/base/srgb.h"

namespace espalier::scenes {
namespace {

/// Linear brightness; what is no number counts as 0.
float brightnessOf(const float* pixel, int channels, bool display) {
  const auto linear = [&](float value) {
    if (!std::isfinite(value) || value < 0.0f) return 0.0f;
    return display ? sim::linearFromSrgb(sim::Colour(value)).r : value;
  };
  return channels < 3 ? linear(pixel[0])
                      : 0.2126f * linear(pixel[0]) + 0.7152f * linear(pixel[1]) + 0.0722f * linear(pixel[2]);
}

/// Means over cells of a degree of the upper half.
std::vector<float> cellsOf(const render::Image& whole, bool display) {
  constexpr int kRows = sim::SkyPicture::kRows, kColumns = sim::SkyPicture::kColumns;
  const auto bounds = [](int cell, int cells, int pixels) {
    const int first = static_cast<int>(std::int64_t{cell} * pixels / cells);
    return std::pair(first, std::max(first + 1, static_cast<int>(std::int64_t{cell + 1} * pixels / cells)));
  };
  const int above = (whole.height + 1) / 2;
  std::vector<float> cells;
  for (int row = 0; row < kRows; ++row) {
    const auto [top, bottom] = bounds(row, kRows, above);
    for (int column = 0; column < kColumns; ++column) {
      const auto [left, right] = bounds(column, kColumns, whole.width);
      double sum = 0.0;
      for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x)
          sum += static_cast<double>(brightnessOf(whole.at(x, y), whole.channels, display));
      }
      cells.push_back(static_cast<float>(sum / (double{1} * (bottom - top) * (right - left))));
    }
  }
  return cells;
}

}  // namespace

std::string packedSky(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw sim::InputError("cannot be read");
  bool display = false;
  const render::Image whole = render::oiio().read_panorama(file.string(), kMostSkyPixels, display);
  const std::vector<float> cells = cellsOf(whole, display);
  Packer out;
  out.put(sim::hashOf(bytes));
  out.putArray(cells.data(), cells.size());
  return out.take();
}

sim::SkyPicture skyFromChild(std::string_view bytes, sim::InputFile& read) {
  Unpacker in(bytes);
  read.hash = in.get<std::uint64_t>();
  sim::SkyPicture picture{in.getArray<float>()};
  in.requireEnd();
  if (picture.radiance.size() !=
          std::size_t{sim::SkyPicture::kRows} * std::size_t{sim::SkyPicture::kColumns} ||
      !std::all_of(picture.radiance.begin(), picture.radiance.end(),
                   [](float value) { return std::isfinite(value) && value >= 0.0f; }))
    throw std::runtime_error("a sky that makes no sense");
  return picture;
}

sim::SkyPicture readSky(const std::filesystem::path& file, sim::InputFile& read) {
  return namingFile(file, [&] {
    const std::uintmax_t size = sizeOfFile(file, "picture");
    render::makeReadyToDraw();  // the child would load it for itself, and say less of why it cannot
    read = {cleanText(file.filename().string()), "sky", 0};
    sim::SkyPicture picture = readInChild({"sky", {file.string()}}, limitsFor(size), "picture",
                                          [&](std::string_view bytes) { return skyFromChild(bytes, read); });
    if (std::none_of(picture.radiance.begin(), picture.radiance.end(),
                     [](float value) { return value > 0.0f; }))
      throw sim::InputError("it is black above the horizon; expected a sky");
    return picture;
  });
}

}  // namespace espalier::scenes
