#include "render/voxels/panels.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "render/image/image_io.h"
#include "render/voxels/shadow.h"
#include "sim/base/error.h"
#include "tests/support/little_garden.h"

namespace espalier::render {
namespace {

using sim::kFaceNormals;

constexpr std::array kAll = {Panel::sun_exposure, Panel::sky_exposure,   Panel::threshold,
                             Panel::shadow_matte, Panel::surface_colour, Panel::first_pass};

/// A garden whose fields are made up, so that every value can be told: no need to cast rays for them.
struct Scene {
  Scene()
      : bricks(garden.occupied()),
        sun(madeUp(7)),
        sky(madeUp(11)),
        seen(see(garden.frame(), garden.occupied(), bricks, tests::LittleGarden::camera(), 160, 120)) {
    look.to_sun = glm::normalize(sim::Vec3(-0.55, 0.75, 0.5));
  }
  sim::ExposureField madeUp(int seed) const {
    const sim::Voxel size = garden.frame().size;
    sim::ExposureField field{{size, {}}};
    const int cells = size.x * size.y * size.z;
    for (int i = 0; i < cells; ++i) field.values.push_back(static_cast<std::uint16_t>(i * 40503 * seed));
    return field;
  }
  PanelWorld world() const {
    return {garden.occupied(), bricks, tests::inFront(sun), tests::inFront(sky),
            [this](sim::Voxel v) { return garden.colour(v); }};
  }
  tests::LittleGarden garden;
  sim::Bricks bricks;
  sim::ExposureField sun, sky;
  Visibility seen;
  PanelLook look;
};

TEST(Panels, MeasuredPicturesHoldTheFieldsThemselves) {
  const Scene scene;
  const PanelWorld world = scene.world();
  const PanelPainter painter(scene.seen, world, scene.look, kAll);
  const Image sun = painter.paint(Panel::sun_exposure).measured,
              sky = painter.paint(Panel::sky_exposure).measured;
  const PanelPicture threshold = painter.paint(Panel::threshold);
  const Image colour = painter.paint(Panel::surface_colour).measured;
  EXPECT_EQ(threshold.channel_names, (std::vector<std::string>{"above_threshold", "exposure", "coverage"}));
  int whole = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const auto pixel = scene.seen.pixel(static_cast<std::size_t>(y * 160 + x));
      if (pixel.size() != 1) continue;
      if (pixel[0].face == kSky) {
        ASSERT_EQ(sun.at(x, y)[0], 0.0f);
        ASSERT_EQ(sun.at(x, y)[1], 0.0f);
        ASSERT_EQ(colour.at(x, y)[3], 0.0f);
        continue;
      }
      ++whole;
      const sim::Voxel front = pixel[0].voxel + kFaceNormals[pixel[0].face];
      ASSERT_FLOAT_EQ(sun.at(x, y)[0], scene.sun.at(front));
      ASSERT_FLOAT_EQ(sky.at(x, y)[0], scene.sky.at(front));
      ASSERT_EQ(sky.at(x, y)[1], 1.0f);
      const float exposure = 0.8f * scene.sun.at(front) + 0.2f * scene.sky.at(front);
      ASSERT_NEAR(threshold.measured.at(x, y)[1], exposure, 1e-6f);
      ASSERT_EQ(threshold.measured.at(x, y)[0], threshold.measured.at(x, y)[1] >= 0.3f ? 1.0f : 0.0f);
      ASSERT_FLOAT_EQ(colour.at(x, y)[0], scene.garden.colour(pixel[0].voxel).r);
    }
  }
  EXPECT_GT(whole, 2000);
}

TEST(Panels, AtEdgesFieldsAreMeansOverTheWorldAloneAndColoursArePremultiplied) {
  Scene scene;
  std::fill(scene.sky.values.begin(), scene.sky.values.end(), std::uint16_t{40000});
  const PanelWorld world{scene.garden.occupied(), scene.bricks, tests::inFront(scene.sun),
                         tests::inFront(scene.sky), [](sim::Voxel) { return sim::Colour(0.5f); }};
  const PanelPainter painter(scene.seen, world, scene.look, kAll);
  const Image sky = painter.paint(Panel::sky_exposure).measured;
  const Image colour = painter.paint(Panel::surface_colour).measured;
  int mixed = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      // What lies outside the world sees all; the little garden touches its edge only below and beside the
      // floor.
      const float coverage = sky.at(x, y)[1];
      if (y < 60 && coverage > 0.0f) {
        ASSERT_FLOAT_EQ(sky.at(x, y)[0], 40000.0f / 65535.0f) << x << ' ' << y;
      }
      ASSERT_FLOAT_EQ(colour.at(x, y)[0], 0.5f * coverage);
      ASSERT_EQ(colour.at(x, y)[3], coverage);
      mixed += coverage > 0.0f && coverage < 1.0f;
    }
  }
  EXPECT_GT(mixed, 100);
}

/// A floor seen from above under a field that rises evenly: the picture must rise evenly too, without steps.
TEST(Panels, ExposureIsSmoothOverAFace) {
  const sim::Frame frame{sim::Vec3(0.0), 1.0, {16, 4, 16}};
  sim::BitVolume occupied(frame.size);
  sim::ExposureField field{{frame.size, std::vector<std::uint16_t>(16 * 4 * 16)}};
  for (int z = 0; z < 16; ++z) {
    for (int x = 0; x < 16; ++x) {
      occupied.set({x, 0, z});
      for (int y = 0; y < 4; ++y) field.values[field.index({x, y, z})] = static_cast<std::uint16_t>(4000 * x);
    }
  }
  const sim::Bricks bricks(occupied);
  const Visibility seen = see(frame, occupied, bricks, {{7.5, 12, 7.5}, {7.5, 0, 7.5}, 40}, 120, 120);
  const PanelWorld world{occupied, bricks, {}, tests::inFront(field), {}};
  const std::array panels = {Panel::sky_exposure};
  const Image display = PanelPainter(seen, world, {}, panels).paint(Panel::sky_exposure).display;
  // Viridis's green rises all along; with steps a voxel wide (15 pixels) most neighbours would be equal.
  int equal = 0;
  float greatest = 0.0f;
  for (int x = 1; x < 120; ++x) {
    const float rise = display.at(x, 60)[1] - display.at(x - 1, 60)[1];
    equal += rise == 0.0f;
    greatest = std::max(greatest, rise);
    EXPECT_GE(rise, -1e-5f) << x;
  }
  EXPECT_EQ(equal, 0);
  EXPECT_LT(greatest, 0.012f);
}

TEST(Panels, AShadowIsAsLongAsTheSunSays) {
  // A wall 6 high on a floor; the sun at 45 degrees from the left throws a shadow 6 long to the right.
  const sim::Frame frame{sim::Vec3(0.0), 1.0, {30, 10, 9}};
  sim::BitVolume occupied(frame.size);
  for (int z = 0; z < 9; ++z) {
    for (int x = 0; x < 30; ++x) occupied.set({x, 0, z});
    for (int y = 1; y <= 6; ++y) occupied.set({8, y, z});
  }
  const sim::Bricks bricks(occupied);
  const Visibility seen = see(frame, occupied, bricks, {{15, 40, 4}, {15, 0, 4}, 40}, 400, 130);
  const std::vector<float> lit =
      castShadows(seen, occupied, bricks, glm::normalize(sim::Vec3(-1.0, 1.0, 0.0)));
  int dark = 0, bright = 0;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    const Fragment& f = seen.fragments[i];
    if (f.face != 3 || f.voxel.y != 0) continue;
    const double x = f.voxel.x + static_cast<double>(f.at.y);  // along z, then x, on faces that look up
    if (x > 8.6 && x < 14.4) {
      EXPECT_EQ(lit[i], 0.0f) << x;
      ++dark;
    } else if (x > 14.7 || x < 7.4) {
      EXPECT_EQ(lit[i], 1.0f) << x;
      ++bright;
    }
  }
  EXPECT_GT(dark, 1000);
  EXPECT_GT(bright, 1000);
}

TEST(Panels, ShadowEdgesAreSoftenedAndNothingElse) {
  const Scene scene;
  const std::vector<float> lit =
      castShadows(scene.seen, scene.garden.occupied(), scene.bricks, scene.look.to_sun);
  std::size_t between = 0, dark = 0;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    const Fragment& f = scene.seen.fragments[i];
    ASSERT_TRUE(lit[i] >= 0.0f && lit[i] <= 1.0f);
    between += lit[i] > 0.0f && lit[i] < 1.0f;
    dark += lit[i] == 0.0f;
    if (f.face != kSky && glm::dot(sim::Vec3(kFaceNormals[f.face]), scene.look.to_sun) <= 0.0) {
      ASSERT_EQ(lit[i], 0.0f) << "a face turned away";
    }
  }
  EXPECT_GT(between, 50u);
  EXPECT_LT(between, lit.size() / 10);
  EXPECT_GT(dark, 1000u);
}

TEST(Panels, AreTheSameOnAnyNumberOfThreads) {
  const Scene scene;
  const PanelWorld world = scene.world();
  const auto bytes = [&] {
    std::string all;
    const PanelPainter painter(scene.seen, world, scene.look, kAll);
    for (const Panel panel : kAll) {
      const PanelPicture picture = painter.paint(panel);
      all += encodePng(picture.display) + encodeExr(picture.measured, picture.channel_names);
    }
    return all;
  };
  const std::string many = bytes();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(many, bytes());
}

TEST(ColourMap, ViridisIsTheOneThatWasPublished) {
  const ColourMap viridis("viridis");
  const sim::Colour middle = srgbFromLinear(viridis(0.5f));
  EXPECT_NEAR(middle.r, 0.1276f, 0.005f);
  EXPECT_NEAR(middle.g, 0.5669f, 0.005f);
  EXPECT_NEAR(middle.b, 0.5505f, 0.005f);
  EXPECT_EQ(viridis(-3.0f), viridis(0.0f));
  EXPECT_EQ(viridis(9.0f), viridis(1.0f));
}

TEST(ColourMap, GrowsBrighterAllTheWay) {
  for (const char* name : {"inferno", "viridis", "magma", "plasma"}) {
    const ColourMap map(name);
    float last = -1.0f;
    for (int i = 0; i <= 100; ++i) {
      const sim::Colour c = map(static_cast<float>(i) / 100.0f);
      const float luminance = 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
      EXPECT_GT(luminance, last) << name << ' ' << i;
      last = luminance;
    }
  }
}

TEST(ColourMap, NamesWhatItKnows) {
  try {
    const ColourMap map("veridis");
    FAIL();
  } catch (const sim::InputError& e) {
    EXPECT_NE(std::string(e.what()).find("viridis"), std::string::npos);
  }
}

}  // namespace
}  // namespace espalier::render
