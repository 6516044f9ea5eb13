#include "scenes/show/picture_memory.h"

#include <gtest/gtest.h>

#include "sim/base/memory.h"
#include "tests/support/messages.h"

namespace espalier::scenes {
namespace {

PicturesWanted panels(int width, int height, int count) {
  PicturesWanted wanted;
  wanted.width_px = width;
  wanted.height_px = height;
  for (int i = 0; i < count; ++i) {
    ImageSpec image;
    image.name = "image " + std::to_string(i);
    image.kind = ImageKind::sky_exposure;
    image.camera = "camera " + std::to_string(i);
    wanted.images.push_back(image);
  }
  return wanted;
}

TEST(PictureMemory, FollowsFromPixelsPicturesAndFragments) {
  const double one = pictureBytes(panels(1000, 1000, 1), 1.0);
  EXPECT_GT(one, 1e6 * (12 + 8));  // it is drawn and measured
  EXPECT_DOUBLE_EQ(pictureBytes(panels(2000, 2000, 1), 1.0), 4 * one);
  EXPECT_GT(pictureBytes(panels(1000, 1000, 2), 1.0), one + 1e6 * 90);
  EXPECT_GT(pictureBytes(panels(1000, 1000, 1), 8.0), one + 7e6 * 68);
  EXPECT_EQ(pictureBytes(PicturesWanted{}, 1.0), 0.0);
}

TEST(PictureMemory, GraphsShareTheGroundThatTheyAreDrawnOn) {
  PicturesWanted one = panels(1000, 1000, 1), two = panels(1000, 1000, 2);
  for (PicturesWanted* wanted : {&one, &two}) {
    for (ImageSpec& image : wanted->images) image.kind = ImageKind::graph;
  }
  EXPECT_GT(pictureBytes(one, 1.0), 1e6 * (12 + 12));  // the picture and the ground
  EXPECT_DOUBLE_EQ(pictureBytes(two, 1.0) - pictureBytes(one, 1.0), 1e6 * (12 + 3));
  EXPECT_GT(pictureBytes(one, 8.0), pictureBytes(one, 1.0));
}

TEST(PictureMemory, WhatIsTooMuchIsNamedWithItsPlaceAndWhatWouldFit) {
  Scene scene;
  scene.file = "garden.yaml";
  EXPECT_EQ(tests::messageOf([&] { requirePicturesFit(scene, panels(1280, 960, 3)); }), "no error");
  PicturesWanted wanted = panels(16384, 8192, 1024);
  const auto told = [&] { return tests::messageOf([&] { requirePicturesFit(scene, wanted); }); };
  EXPECT_EQ(told().find("garden.yaml: 1024 images of 16384 x 8192 pixels need "), 0u) << told();
  scene.images_place = {std::make_shared<const std::string>("garden.yaml"), 7, 3};
  const std::string message = told();
  EXPECT_EQ(message.find("garden.yaml:7:3: 1024 images of "), 0u) << message;
  int width = 0, height = 0;
  const auto at = message.find("expected at most ");
  ASSERT_NE(at, std::string::npos) << message;
  ASSERT_EQ(std::sscanf(message.c_str() + at, "expected at most %d x %d pixels", &width, &height), 2);
  EXPECT_NEAR(static_cast<double>(width) / height, 2.0, 0.05);
  wanted.width_px = width;
  wanted.height_px = height;
  EXPECT_EQ(told(), "no error");
  wanted.width_px = width + width / 20;
  wanted.height_px = height + height / 20;
  EXPECT_NE(told(), "no error");
}

TEST(PictureMemory, ACameraMaySeeWhatTheBudgetLeaves) {
  EXPECT_EQ(mostFragments(panels(640, 480, 1)), 8u * 640 * 480);
  EXPECT_EQ(mostFragments(panels(16384, 16384, 1000)), 16384u * 16384u);
  EXPECT_EQ(mostFragments(PicturesWanted{}), 0u);
}

}  // namespace
}  // namespace espalier::scenes
