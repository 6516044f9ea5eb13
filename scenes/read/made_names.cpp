#include "scenes/read/made_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace espalier::scenes {
namespace {

using rules::Check;

constexpr std::array<std::string_view, 5> kModels{"plant", "plant_lod1", "plant_lod2", "plant_lod3", "diced"};

void checkName(const std::string& name, const std::string& path, const Check::Complain& complain) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  if (name.size() > 100 || !std::all_of(name.begin(), name.end(), plain)) {
    complain(path, fmt::format("{} is no name of a file; expected letters, digits, _ and -, at most 100",
                               inQuotes(name)));
  } else if (std::find(kModels.begin(), kModels.end(), name) != kModels.end()) {
    complain(path, fmt::format("{}.glb is written by every run, or may be; expected another name", name));
  }
}

}  // namespace

void checkMadeNames(const Scene& scene, const Check::Given&, const Check::Complain& complain) {
  for (const PiecesSpec& pieces : scene.pieces) checkName(pieces.name, "pieces." + pieces.name, complain);
  for (const HeightsSpec& heights : scene.heights) {
    const std::string path = "heights." + heights.name;
    checkName(heights.name, path, complain);
    if (std::any_of(scene.pieces.begin(), scene.pieces.end(),
                    [&](const PiecesSpec& pieces) { return pieces.name == heights.name; }))
      complain(path, fmt::format("pieces are called {} too, and both are {}.glb; expected another name",
                                 inQuotes(heights.name), heights.name));
    // An image may be an EXR file too.
    if (std::any_of(scene.images.begin(), scene.images.end(),
                    [&](const ImageSpec& image) { return image.name == heights.name; }))
      complain(path, fmt::format("an image is called {} too, and both may be {}.exr; expected another name",
                                 inQuotes(heights.name), heights.name));
  }
}

}  // namespace espalier::scenes
