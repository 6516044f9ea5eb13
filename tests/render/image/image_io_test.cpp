#include "render/image/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "render/image/tone.h"
#include "sim/base/error.h"

namespace espalier::render {
namespace {

Image ramp(int width, int height, int channels) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        image.at(x, y)[c] =
            0.5f + 0.5f * sinf(0.013f * static_cast<float>(x * (c + 1)) + 0.021f * static_cast<float>(y));
      }
    }
  }
  return image;
}

struct Decoded {
  OIIO::ImageSpec spec;
  std::vector<float> pixels;
};

Decoded decode(const std::string& bytes, const char* format) {
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  const auto in = OIIO::ImageInput::open(std::string("memory.") + format, nullptr, &memory);
  Decoded decoded;
  EXPECT_TRUE(in) << OIIO::geterror();
  if (!in) return decoded;
  decoded.spec = in->spec();
  decoded.pixels.resize(static_cast<std::size_t>(decoded.spec.image_pixels()) *
                        static_cast<std::size_t>(decoded.spec.nchannels));
  EXPECT_TRUE(in->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, decoded.pixels.data()));
  return decoded;
}

TEST(ImageIo, ExrKeepsFloatsNamesAndMetadataExactly) {
  Image image = ramp(37, 23, 2);
  image.at(3, 4)[1] = -7.25e8f;
  const Decoded back =
      decode(encodeExr(image, {"sky_exposure", "sun_exposure"}, {{"weighting", "uniform"}}), "exr");
  EXPECT_EQ(back.spec.width, 37);
  EXPECT_EQ(back.spec.height, 23);
  EXPECT_EQ(back.spec.channelnames, (std::vector<std::string>{"sky_exposure", "sun_exposure"}));
  EXPECT_EQ(back.spec.get_string_attribute("weighting"), "uniform");
  EXPECT_EQ(back.pixels, image.pixels);
}

TEST(ImageIo, PngKeepsDisplayValuesWithinHalfAStepAndClamps) {
  Image image = ramp(37, 23, 3);
  image.at(0, 0)[0] = 7.0f;
  image.at(0, 0)[1] = -1.0f;
  const Decoded back = decode(encodePng(image, {{"weighting", "uniform"}}), "png");
  EXPECT_EQ(back.spec.get_string_attribute("weighting"), "uniform");
  ASSERT_EQ(back.pixels.size(), image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    EXPECT_NEAR(back.pixels[i], std::clamp(image.pixels[i], 0.0f, 1.0f), 0.5f / 255.0f + 1e-6f) << i;
}

TEST(ImageIo, PngAlphaIsNotPremultiplied) {
  Image image(2, 1, 4, 0.5f);
  image.at(1, 0)[3] = 0.0f;
  const std::string bytes = encodePng(image);
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  OIIO::Filesystem::IOProxy* proxy = &memory;
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<void*>(&proxy));
  const auto in = OIIO::ImageInput::open("memory.png", &config);
  ASSERT_TRUE(in);
  std::vector<float> pixels(8);
  ASSERT_TRUE(in->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, pixels.data()));
  EXPECT_NEAR(pixels[0], 0.5f, 0.003f);
  EXPECT_NEAR(pixels[4], 0.5f, 0.003f);
  EXPECT_EQ(pixels[7], 0.0f);
}

TEST(ImageIo, BytesDoNotDependOnTheTimeOfDay) {
  const Image image = ramp(64, 64, 3);
  const std::string png = encodePng(image);
  const std::string exr = encodeExr(image, {"R", "G", "B"});
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // stamps count seconds
  EXPECT_EQ(png, encodePng(image));
  EXPECT_EQ(exr, encodeExr(image, {"R", "G", "B"}));
}

TEST(ImageIo, RefusesWhatCannotBeWritten) {
  Image holed(4, 4, 1);
  holed.at(2, 1)[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(encodePng(holed), sim::InputError);
  EXPECT_THROW(encodeExr(holed, {"Y"}), sim::InputError);
  EXPECT_THROW(encodePng(Image()), sim::InputError);
  EXPECT_THROW(encodePng(Image(4, 4, 2)), sim::InputError);
  EXPECT_THROW(encodeExr(Image(4, 4, 2), {"Y"}), sim::InputError);
  Image cut(4, 4, 3);
  cut.pixels.pop_back();
  EXPECT_THROW(encodePng(cut), sim::InputError);
}

TEST(ImageIo, HeadersSayByWhatAndFromWhatAPictureWasMade) {
  const sim::Provenance made_by{
      "Espalier 9.8.7", 42, {{"s.yaml", "scene", 0xabcu}, {"a b.obj", "mesh", ~0ull}}};
  const Metadata texts = textsOf(made_by);
  for (const auto& back : {decode(encodePng(ramp(8, 8, 3), texts), "png"),
                           decode(encodeExr(ramp(8, 8, 1), {"Y"}, texts), "exr")}) {
    EXPECT_EQ(back.spec.get_string_attribute("Software"), "Espalier 9.8.7");
    EXPECT_EQ(back.spec.get_string_attribute("espalier:seed"), "42");
    EXPECT_EQ(back.spec.get_string_attribute("espalier:inputs"),
              "0000000000000abc scene s.yaml\nffffffffffffffff mesh a b.obj");
  }
}

TEST(Tone, SrgbIsTheStandardsCurve) {
  EXPECT_NEAR(srgbFromLinear(0.5f), 0.73536f, 1e-5f);  // IEC 61966-2-1
  for (int i = -1000; i <= 101'000; ++i) {
    const float v = static_cast<float>(i) / 100'000.0f;
    const double within = std::clamp(static_cast<double>(v), 0.0, 1.0);
    const double standard =
        within <= 0.0031308 ? 12.92 * within : 1.055 * std::pow(within, 1.0 / 2.4) - 0.055;
    ASSERT_NEAR(srgbFromLinear(v), standard, 2.5e-7) << v;
  }
  EXPECT_TRUE(std::isnan(srgbFromLinear(std::numeric_limits<float>::quiet_NaN())));
}

TEST(Tone, TheCurveRisesFromBlackToWhite) {
  const ToneCurve curve;
  EXPECT_EQ(curve(0.0f), 0.0f);
  EXPECT_FLOAT_EQ(curve(curve.white / curve.exposure), 1.0f);
  float last = -1.0f;
  for (int i = 0; i <= 64; ++i) {
    const float now = curve(curve.white / curve.exposure * static_cast<float>(i) / 64.0f);
    EXPECT_GT(now, last);
    last = now;
  }
  EXPECT_GT(curve(0.05f), 0.05f) << "dark areas must come out brighter";
}

TEST(DecodePng, GivesBackWhatWasEncoded) {
  Image image(5, 3, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(5 * i % 256) / 255.0f;
  const Image back = decodePng(encodePng(image));
  ASSERT_EQ(back.width, 5);
  ASSERT_EQ(back.height, 3);
  EXPECT_EQ(back.pixels, image.pixels);
  EXPECT_THROW(decodePng("no picture"), sim::InputError);
}

}  // namespace
}  // namespace espalier::render
