#include "scenes/import/density_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/image/image_io.h"
#include "scenes/import/wire.h"
#include "tests/support/messages.h"
#include "tests/support/png_bytes.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

using tests::pngBytes;

class DensityReader : public testing::Test {
 protected:
  sim::DensityPicture readBytes(const std::string& name, const std::string& bytes) {
    return readDensity(scratch_.write(name, bytes), read_);
  }
  std::string said(const std::string& name, const std::string& bytes) {
    return tests::messageOf([&] { readBytes(name, bytes); });
  }
  tests::Scratch scratch_;
  sim::InputFile read_;
};

constexpr int kPngGrey = 0, kPngRgb = 2, kPngGreyAlpha = 4, kPngRgba = 6;

TEST_F(DensityReader, TakesValuesAsTheyAre) {
  // No curve of sRGB is undone: a value of 100 is half as dense as one of 200.
  const auto grey = readBytes("grey.png", pngBytes(3, 2, 8, kPngGrey, {0, 100, 200, 50, 200, 20}));
  EXPECT_EQ(grey.width, 3);
  EXPECT_EQ(grey.height, 2);
  const std::vector<float> expected{0.0f, 0.5f, 1.0f, 0.25f, 1.0f, 0.1f};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(grey.density[i], expected[i], 1e-5f);
  EXPECT_EQ(read_.kind, "density");
  EXPECT_EQ(read_.name, "grey.png");
  // 16 bits: of 40000 a step of one shows.
  const auto fine = readBytes("fine.png", pngBytes(2, 1, 16, kPngGrey, {0x9c, 0x40, 0x9c, 0x3f}));
  EXPECT_EQ(fine.density[0], 1.0f);
  EXPECT_NEAR(fine.density[1], 39999.0f / 40000.0f, 1e-6f);
}

TEST_F(DensityReader, TakesOfColoursTheLuminanceAndMultipliesByAlpha) {
  const auto colours =
      readBytes("rgb.png", pngBytes(4, 1, 8, kPngRgb, {255, 255, 255, 255, 0, 0, 0, 255, 0, 0, 0, 255}));
  for (const auto& [i, share] : {std::pair{1u, 0.2126f}, {2u, 0.7152f}, {3u, 0.0722f}})
    EXPECT_NEAR(colours.density[i], share, 1e-4f);
  const auto clear = readBytes(
      "rgba.png", pngBytes(3, 1, 8, kPngRgba, {200, 200, 200, 255, 200, 200, 200, 51, 255, 255, 255, 0}));
  EXPECT_NEAR(clear.density[1], 0.2f, 1e-4f);
  EXPECT_EQ(clear.density[2], 0.0f);
  const auto both = readBytes("ga.png", pngBytes(2, 1, 8, kPngGreyAlpha, {100, 255, 100, 102}));
  EXPECT_NEAR(both.density[1], 0.4f, 1e-4f);
}

TEST_F(DensityReader, ReadsAnExrBeyondOne) {
  render::Image image(5, 1, 1);
  for (int x = 0; x < 5; ++x) *image.at(x, 0) = 1000.0f * static_cast<float>(x);
  const auto picture = readBytes("people.exr", render::encodeExr(image, {"Y"}));
  for (int x = 0; x < 5; ++x)
    EXPECT_NEAR(picture.density[static_cast<std::size_t>(x)], 0.25f * static_cast<float>(x), 1e-4f);
  *image.at(3, 0) = -0.5f;
  EXPECT_NE(said("below.exr", render::encodeExr(image, {"Y"}))
                .find("it has the value -0.5 in column 4 of row 1, from 1; expected numbers of 0 or more"),
            std::string::npos);
}

TEST_F(DensityReader, RefusesGiantsBeforeTheyAreRead) {
  // Heads alone, of pictures that would take gigabytes; what follows is a byte.
  EXPECT_NE(said("giant.png", pngBytes(100'000, 100'000, 8, kPngGrey, {0}))
                .find("it has 100000 x 100000 pixels; expected at most 16384 on a side and 16777216 in all"),
            std::string::npos);
  EXPECT_NE(said("long.png", pngBytes(20'000, 1, 8, kPngGrey, {0})).find("20000 x 1 pixels"),
            std::string::npos);
  EXPECT_NE(said("large.png", pngBytes(8192, 8192, 16, kPngRgba, {0})).find("8192 x 8192"),
            std::string::npos);
}

TEST_F(DensityReader, RefusesWhatIsNoPicture) {
  EXPECT_NE(said("black.png", pngBytes(2, 2, 8, kPngGrey, {0, 0, 0, 0})).find("black everywhere"),
            std::string::npos);
  EXPECT_NE(said("text.png", "a picture, honestly").find("no picture that can be read"), std::string::npos);
  EXPECT_NE(said("empty.png", "").find("empty"), std::string::npos);
  const std::string whole = pngBytes(64, 64, 8, kPngGrey, std::vector<std::uint8_t>(64 * 64, 9));
  EXPECT_NE(said("cut.png", whole.substr(0, whole.size() / 2)), "");
  const auto missing = scratch_.path("none.png");
  EXPECT_TRUE(tests::messageOf([&] { readDensity(missing, read_); }).starts_with(missing.string()));
}

TEST_F(DensityReader, DoesNotTrustItsChild) {
  const auto sent = [&](std::int32_t width, std::int32_t height, const std::vector<float>& shares) {
    Packer out;
    out.put(std::uint64_t{7});
    out.put(width);
    out.put(height);
    out.putArray(shares.data(), shares.size());
    const std::string bytes = out.take();
    densityFromChild(bytes, read_);
  };
  EXPECT_NO_THROW(sent(2, 1, {0.5f, 1.0f}));
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 2}, {-2, -1}, {0, 0}, {1 << 20, 1}})
    EXPECT_THROW(sent(width, height, {0.5f, 1.0f}), std::runtime_error) << width;
  EXPECT_THROW(sent(2, 1, {0.5f, 0.5f}), std::runtime_error);
  EXPECT_THROW(sent(2, 1, {1.0f, -0.5f}), std::runtime_error);
  EXPECT_THROW(sent(2, 1, {1.0f, std::numeric_limits<float>::quiet_NaN()}), std::runtime_error);
}

}  // namespace
}  // namespace espalier::scenes
