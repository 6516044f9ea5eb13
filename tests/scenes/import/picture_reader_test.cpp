#include "scenes/import/picture_reader.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "render/image/image_io.h"
#include "scenes/import/wire.h"
#include "sim/base/error.h"
#include "sim/base/hasher.h"
#include "tests/support/messages.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

std::string pngOf(int width, int height, int channels, const std::vector<float>& pixel) {
  render::Image image(width, height, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = pixel[i % pixel.size()];
  return render::encodePng(image);
}

class PictureReader : public testing::Test {
 protected:
  void expectRefused(const std::filesystem::path& file, const std::string& because) {
    const std::string said = tests::messageOf([&] { readPicture(file, read_); });
    EXPECT_TRUE(said.starts_with(file.string() + ": ")) << said;
    EXPECT_NE(said.find(because), std::string::npos) << said;
  }

  tests::Scratch scratch_;
  sim::InputFile read_;
};

TEST_F(PictureReader, ReadsColoursAndAlphaAsTheyAre) {
  const std::string bytes = pngOf(3, 2, 4, {1.0f, 0.4f, 0.2f, 0.6f});
  const auto picture = readPicture(scratch_.write("leaf.png", bytes), read_);
  EXPECT_EQ(picture->width, 3);
  EXPECT_EQ(picture->height, 2);
  ASSERT_EQ(picture->texels.size(), 6u);
  EXPECT_EQ(picture->texels[4], (std::array<std::uint8_t, 4>{255, 102, 51, 153}))
      << "alpha is not premultiplied";
  EXPECT_EQ(picture->png, bytes);
  EXPECT_EQ(picture->name, "leaf.png");
  EXPECT_EQ(read_.kind, "picture");
  EXPECT_EQ(read_.hash, sim::hashOf(bytes));
  const sim::Colour mean = meanColour(*picture);
  EXPECT_NEAR(mean.r, 1.0f, 1e-5f);
  EXPECT_NEAR(mean.g, 0.1329f, 1e-3f);
}

TEST_F(PictureReader, WithoutAlphaIsOpaqueAndGreyIsGrey) {
  const auto grey = readPicture(scratch_.write("g.png", pngOf(2, 2, 1, {0.2f})), read_);
  EXPECT_EQ(grey->texels[0], (std::array<std::uint8_t, 4>{51, 51, 51, 255}));
  const auto rgb = readPicture(scratch_.write("c.png", pngOf(2, 2, 3, {0.0f, 1.0f, 0.2f})), read_);
  EXPECT_EQ(rgb->texels[3], (std::array<std::uint8_t, 4>{0, 255, 51, 255}));
}

TEST_F(PictureReader, WhatSomebodyStillHasIsDecodedOnce) {
  const auto file = scratch_.write("leaf.png", pngOf(2, 2, 1, {0.2f}));
  auto first = readPicture(file, read_);
  const sim::InputFile noted = read_;
  EXPECT_EQ(readPicture(file, read_), first);
  EXPECT_EQ(read_, noted);
  // Other bytes are another picture, and so is another name; one that nobody has is not kept.
  scratch_.write("leaf.png", pngOf(2, 2, 1, {0.4f}));
  const auto other = readPicture(file, read_);
  EXPECT_NE(other, first);
  EXPECT_EQ(other->texels[0][0], 102);
  EXPECT_NE(readPicture(scratch_.write("b.png", pngOf(2, 2, 1, {0.4f})), read_), other);
  const std::weak_ptr<const sim::Picture> gone = std::exchange(first, nullptr);
  EXPECT_TRUE(gone.expired());
}

TEST_F(PictureReader, RefusesWhatIsNoPicture) {
  expectRefused(scratch_.path("none.png"), "none.png");
  expectRefused(scratch_.write("text.png", "a leaf, honestly"), "it is no PNG; expected one");
  expectRefused(scratch_.write("empty.png", ""), "empty");
  const std::string whole = pngOf(40, 40, 4, {0.1f, 0.9f, 0.3f, 1.0f, 0.5f, 0.4f, 0.7f, 0.9f});
  for (const double share : {0.2, 0.5, 0.9}) {
    const auto bytes = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
    expectRefused(scratch_.write("cut.png", whole.substr(0, bytes)), "damaged or cut; expected a whole PNG");
  }
  expectRefused(scratch_.write("clear.png", pngOf(4, 4, 4, {1.0f, 1.0f, 1.0f, 0.3f})),
                "nothing of it is opaque");
}

// A few bytes that would become gigabytes: the size is judged before a pixel is read.
TEST_F(PictureReader, RefusesAPictureOfTooManyPixels) {
  std::string bomb = pngOf(8, 8, 4, {1.0f});
  const auto put = [&](std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bomb[at + i] = static_cast<char>(value >> (24 - 8 * i));
  };
  put(16, 60'000);
  put(20, 60'000);
  // The header's checksum, CRC-32 as PNG has it.
  std::uint32_t crc = 0xffffffffu;
  for (std::size_t i = 12; i < 29; ++i) {
    crc ^= static_cast<std::uint8_t>(bomb[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
  }
  put(29, ~crc);
  expectRefused(scratch_.write("bomb.png", bomb),
                "it has 60000 x 60000 pixels; expected at most 8192 on a side");
}

TEST_F(PictureReader, DoesNotTrustWhatTheChildSent) {
  Packer out;
  out.put(std::uint64_t{1});
  out.put(std::int32_t{2});
  out.put(std::int32_t{2});
  const std::vector<std::array<std::uint8_t, 4>> three(3);
  out.putArray(three.data(), three.size());
  out.putText("png");
  const std::string bytes = out.take();
  EXPECT_THROW(pictureFromChild(bytes, read_), std::runtime_error);
  EXPECT_THROW(pictureFromChild(bytes.substr(0, 9), read_), std::runtime_error);
}

}  // namespace
}  // namespace espalier::scenes
