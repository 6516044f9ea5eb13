#include "scenes/import/sky_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/image/image_io.h"
#include "scenes/import/wire.h"
#include "tests/support/messages.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

/// Its brightness rises from left to right, and is `below` under the horizon.
render::Image sky(int width, int height, float below) {
  render::Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      std::fill_n(image.at(x, y), 3,
                  2 * y < height ? 0.25f + 0.5f * static_cast<float>(x) / static_cast<float>(width) : below);
  }
  return image;
}

class SkyReader : public testing::Test {
 protected:
  std::string said(const std::filesystem::path& file) {
    return tests::messageOf([&] { readSky(file, read_); });
  }
  tests::Scratch scratch_;
  sim::InputFile read_;
};

TEST_F(SkyReader, AnExrIsReadAsItIs) {
  const auto file = scratch_.write("sky.exr", render::encodeExr(sky(720, 360, 9.0f), {"r", "g", "b"}));
  const sim::SkyPicture picture = readSky(file, read_);
  ASSERT_EQ(picture.radiance.size(), 90u * 360u);
  EXPECT_NEAR(picture.radiance[0], 0.25f + 0.5f * 0.5f / 720.0f, 1e-5f);
  EXPECT_NEAR(picture.radiance[89 * 360 + 180], 0.5f + 0.5f * 0.5f / 720.0f, 1e-5f);
  EXPECT_EQ(read_.kind, "sky");
}

TEST_F(SkyReader, APngIsSrgbAndMayBeSmall) {
  const sim::SkyPicture picture =
      readSky(scratch_.write("sky.png", render::encodePng(sky(8, 4, 0.0f))), read_);
  EXPECT_NEAR(picture.radiance[0], std::pow((0.25f + 0.055f) / 1.055f, 2.4f), 4e-3f);
}

TEST_F(SkyReader, RefusesWhatIsNoSky) {
  EXPECT_NE(said(scratch_.write("square.png", render::encodePng(sky(8, 8, 0.5f))))
                .find("8 x 8 pixels; expected twice as wide as high"),
            std::string::npos);
  render::Image black(8, 4, 3);
  EXPECT_NE(said(scratch_.write("black.png", render::encodePng(black))).find("black above the horizon"),
            std::string::npos);
  EXPECT_NE(said(scratch_.write("text.png", "a sky, honestly")).find("no picture that can be read"),
            std::string::npos);
  EXPECT_NE(said(scratch_.write("empty.png", "")).find("empty"), std::string::npos);
  EXPECT_TRUE(said(scratch_.path("none.exr")).starts_with(scratch_.path("none.exr").string()));
  const std::string whole = render::encodeExr(sky(64, 32, 1.0f), {"r", "g", "b"});
  EXPECT_NE(said(scratch_.write("cut.exr", whole.substr(0, whole.size() / 2))), "");
}

TEST_F(SkyReader, DoesNotTrustItsChild) {
  const auto sent = [&](const std::vector<float>& cells) {
    Packer out;
    out.put(std::uint64_t{7});
    out.putArray(cells.data(), cells.size());
    const std::string bytes = out.take();
    skyFromChild(bytes, read_);
  };
  EXPECT_NO_THROW(sent(std::vector<float>(90 * 360, 0.5f)));
  EXPECT_THROW(sent(std::vector<float>(90 * 359, 0.5f)), std::runtime_error);
  EXPECT_THROW(sent(std::vector<float>(90 * 360, -1.0f)), std::runtime_error);
  EXPECT_THROW(sent(std::vector<float>(90 * 360, std::numeric_limits<float>::infinity())),
               std::runtime_error);
}

}  // namespace
}  // namespace espalier::scenes
