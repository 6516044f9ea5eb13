#pragma once
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "render/image/image.h"
#include "render/image/image_io.h"
#include "sim/base/whole_file.h"

namespace espalier::tests {

/// Compares a picture of display values with tests/golden/NAME.png. A pixel may be off by `tolerance`, one in
/// two hundred by more, none by a quarter. A failure leaves the result and the difference, four times
/// enlarged, in the build folder and names them. ESPALIER_UPDATE_GOLDEN=1 writes the golden pictures anew
/// instead.
inline void expectLikeGolden(const render::Image& display, const std::string& name,
                             float tolerance = 0.016f) {
  namespace fs = std::filesystem;
  const fs::path golden = fs::path(ESPALIER_SOURCE_DIR) / "tests" / "golden" / (name + ".png");
  if (const char* update = std::getenv("ESPALIER_UPDATE_GOLDEN"); update && std::string(update) == "1") {
    fs::create_directories(golden.parent_path());
    sim::writeWhole(golden, render::encodePng(display));
    return;
  }
  ASSERT_TRUE(fs::exists(golden)) << golden
                                  << " is missing; run with ESPALIER_UPDATE_GOLDEN=1 and look at it";
  render::Image copy = display;
  const OIIO::ImageBuf result(OIIO::ImageSpec(copy.width, copy.height, copy.channels, OIIO::TypeDesc::FLOAT),
                              copy.pixels.data());
  const OIIO::ImageBuf expected(golden.string());
  const bool same_shape = expected.spec().width == display.width &&
                          expected.spec().height == display.height &&
                          expected.nchannels() == display.channels;
  bool alike = false;
  OIIO::ImageBufAlgo::CompareResults found{};
  if (same_shape) {
    found = OIIO::ImageBufAlgo::compare(result, expected, tolerance, tolerance, OIIO::ROI(), 1);
    const auto pixels =
        static_cast<unsigned long>(display.width) * static_cast<unsigned long>(display.height);
    alike = !found.error && found.nfail * 200 <= pixels && found.maxerror < 0.25;
  }
  if (alike) return;

  const fs::path folder = fs::path(ESPALIER_PROGRAM).parent_path() / "golden_failures";
  fs::create_directories(folder);
  const fs::path result_path = folder / (name + ".png"),
                 difference_path = folder / (name + "_difference.png");
  sim::writeWhole(result_path, render::encodePng(display));
  if (same_shape) {
    const OIIO::ImageBuf difference =
        OIIO::ImageBufAlgo::mul(OIIO::ImageBufAlgo::absdiff(result, expected), 4.0f);
    difference.write(difference_path.string(), OIIO::TypeDesc::UINT8);
  }
  ADD_FAILURE() << "the picture differs from " << golden << "\n  result     " << result_path
                << "\n  difference " << (same_shape ? difference_path.string() : "none: another size")
                << "\n  " << found.nfail << " pixels off by more than " << tolerance << ", the worst by "
                << found.maxerror << " at (" << found.maxx << ", " << found.maxy << ")";
}

}  // namespace espalier::tests
