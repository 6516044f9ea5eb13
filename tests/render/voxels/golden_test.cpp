#include "tests/support/golden.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/image/contact_sheet.h"
#include "render/image/legend.h"
#include "render/voxels/attempts.h"
#include "render/voxels/panels.h"
#include "render/voxels/section.h"
#include "tests/support/little_garden.h"

namespace espalier::render {
namespace {

constexpr std::array kPanels = {Panel::sun_exposure, Panel::sky_exposure,   Panel::threshold,
                                Panel::shadow_matte, Panel::surface_colour, Panel::first_pass};
constexpr std::array kNames = {"sun_exposure", "sky_exposure",   "threshold",
                               "shadow_matte", "surface_colour", "first_pass"};

std::vector<Image> paintAll(int width, int height) {
  const tests::LittleGarden garden;
  const sim::Bricks bricks(garden.occupied());
  const sim::ExposureField sun = garden.exposure(tests::LittleGarden::sunArc());
  const sim::ExposureField sky = garden.exposure(tests::LittleGarden::sky());
  const Visibility seen =
      see(garden.frame(), garden.occupied(), bricks, tests::LittleGarden::camera(), width, height);
  const PanelWorld world{garden.occupied(), bricks, tests::inFront(sun), tests::inFront(sky),
                         [&](sim::Voxel v) { return garden.colour(v); }};
  PanelLook look;
  look.to_sun = glm::normalize(sim::Vec3(-0.55, 0.75, 0.5));
  const PanelPainter painter(seen, world, look, kPanels);
  std::vector<Image> pictures;
  for (const Panel panel : kPanels) pictures.push_back(painter.paint(panel, {.least = 0.55f}).display);
  return pictures;
}

TEST(Golden, PanelsOfTheLittleGarden) {
  const std::vector<Image> pictures = paintAll(160, 120);
  for (std::size_t i = 0; i < pictures.size(); ++i)
    tests::expectLikeGolden(pictures[i], std::string("panel_") + kNames[i]);
}

TEST(Golden, ContactSheet) {
  const std::vector<Image> pictures = paintAll(240, 180);
  std::vector<Captioned> captioned;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    captioned.push_back({&pictures[i], std::string(1, static_cast<char>('A' + i)), kNames[i]});
  tests::expectLikeGolden(contactSheet(captioned, {3, 120, "The little garden"}), "contact_sheet");
}

TEST(Golden, Legends) {
  Image bar(300, 130, 3, 0.45f);
  drawLegend(bar, BarLegend{"sky exposure", "fraction of the sky seen, solid-angle weighted"},
             ColourMap("viridis"));
  tests::expectLikeGolden(bar, "legend_bar");
  Image swatches(200, 120, 3, 0.45f);
  const ThresholdColours colours = thresholdColours();
  drawLegend(swatches, SwatchLegend{"illumination threshold",
                                    "exposure = 0.8 sun + 0.2 sky",
                                    {{colours.above, "0.3 and above"}, {colours.below, "below"}}});
  tests::expectLikeGolden(swatches, "legend_swatches");
}

TEST(Golden, SectionThroughAColumn) {
  const auto layer = [](glm::ivec2 v) {
    int nearest = 99;
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 30; ++x)
        if ((x - 16) * (x - 16) + (y - 17) * (y - 17) < 20)
          nearest = std::min(nearest, std::max(std::abs(x - v.x), std::abs(y - v.y)));
    return nearest;
  };
  const Image section = drawSection(
      [&](glm::ivec2 v) {
        const int k = layer(v);
        return Cut{k == 0, k <= 4 ? k : 0, sim::Colour(0.45f, 0.33f, 0.24f)};
      },
      {{30, 30}, 4, 240, "boundary layers"});
  tests::expectLikeGolden(section, "section");
}

TEST(Golden, AttemptsOfAWalk) {
  std::vector<Attempt> attempts;
  std::vector<glm::ivec2> voxels;
  glm::dvec2 tip(3, 1);
  double heading = 0.9;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 7; ++j) {
      const double angle = heading + 0.25 * (j - 3);
      const glm::dvec2 next = tip + 2.0 * glm::dvec2(std::cos(angle), std::sin(angle));
      attempts.push_back({tip, next, j == (i * 5) % 7});
    }
    heading += 0.25 * ((i * 5) % 7 - 3);
    tip += 2.0 * glm::dvec2(std::cos(heading), std::sin(heading));
    voxels.emplace_back(static_cast<int>(std::lround(tip.x)), static_cast<int>(std::lround(tip.y)));
  }
  tests::expectLikeGolden(drawAttempts(attempts, voxels, {{16, 16}, 140}), "attempts");
}

}  // namespace
}  // namespace espalier::render
