#include "scenes/import/density_reader.h"

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

namespace espalier::scenes {
namespace {

/// Shares of the greatest value.
std::vector<float> sharesOf(render::Image picture) {
  float most = 0.0f;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const float value = *picture.at(x, y);
      if (!std::isfinite(value) || value < 0.0f)
        throw sim::InputError(
            fmt::format("it has the value {} in column {} of row {}, from 1; expected numbers of 0 or more",
                        value, x + 1, y + 1));
      most = std::max(most, value);
    }
  }
  if (most == 0.0f)
    throw sim::InputError("it is black everywhere; expected a picture of which some is brighter");
  for (float& value : picture.pixels) value = std::min(1.0f, value / most);
  return std::move(picture.pixels);
}

}  // namespace

std::string packedDensity(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw sim::InputError("cannot be read");
  render::Image picture = render::oiio().read_luminance(file.string(), kMostDensityPixels, kMostDensitySide);
  Packer out;
  out.put(sim::hashOf(bytes));
  out.put(static_cast<std::int32_t>(picture.width));
  out.put(static_cast<std::int32_t>(picture.height));
  const std::vector<float> shares = sharesOf(std::move(picture));
  out.putArray(shares.data(), shares.size());
  return out.take();
}

sim::DensityPicture densityFromChild(std::string_view bytes, sim::InputFile& read) {
  Unpacker in(bytes);
  read.hash = in.get<std::uint64_t>();
  sim::DensityPicture picture;
  picture.width = in.get<std::int32_t>();
  picture.height = in.get<std::int32_t>();
  picture.density = in.getArray<float>();
  in.requireEnd();
  const auto within = [](std::int32_t side) { return side > 0 && side <= kMostDensitySide; };
  if (!within(picture.width) || !within(picture.height) ||
      picture.density.size() !=
          static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) ||
      !std::all_of(picture.density.begin(), picture.density.end(),
                   [](float d) { return d >= 0.0f && d <= 1.0f; }) ||
      std::find(picture.density.begin(), picture.density.end(), 1.0f) == picture.density.end())
    throw std::runtime_error("a density that makes no sense");
  return picture;
}

sim::DensityPicture readDensity(const std::filesystem::path& file, sim::InputFile& read) {
  return namingFile(file, [&] {
    const std::uintmax_t size = sizeOfFile(file, "picture");
    render::makeReadyToDraw();  // the child would load it for itself, and say less of why it cannot
    read = {cleanText(file.filename().string()), "density", 0};
    return readInChild({"density", {file.string()}}, limitsFor(size), "picture",
                       [&](std::string_view bytes) { return densityFromChild(bytes, read); });
  });
}

}  // namespace espalier::scenes
