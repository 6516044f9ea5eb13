#include "scenes/read/heights_keys.h"

#include <fmt/format.h>

#include <algorithm>

#include "rules/language/key_builder.h"
#include "scenes/problem.h"
#include "scenes/read/units.h"

namespace espalier::scenes {
namespace {

using rules::Limits;
using rules::TableOf;

constexpr Limits kHeight{-1e6, 1e6};
constexpr Limits kLength{0.0, 1e6};
constexpr Limits kMore{0.0, 1e6, true};
constexpr Limits kSteep{0.0, 90.0};

std::shared_ptr<const rules::Table> noiseKeys() {
  return TableOf<sim::ReliefNoise>()
      .metres("amplitude", &sim::ReliefNoise::amplitude_m,
              {.unit = kMetres,
               .limits = kLength,
               .meaning = "Its standard deviation far from lines, of the longest waves.",
               .required = true})
      .metres("scale", &sim::ReliefNoise::scale_m,
              {.unit = kMetres, .limits = kMore, .meaning = "The longest waves.", .required = true})
      .whole("octaves", &sim::ReliefNoise::octaves,
             {.unit = "octaves",
              .limits = {1.0, 16.0},
              .meaning = "Each with waves half as long and half as high; those that the spacing cannot show "
                         "are left out."})
      .shared();
}

std::shared_ptr<const rules::Table> meanderKeys() {
  return TableOf<sim::Meander>()
      .metres(
          "amplitude", &sim::Meander::amplitude_m,
          {.unit = kMetres,
           .limits = kLength,
           .meaning = "Its standard deviation along x and z, of the longest waves; a thirtieth of the scale "
                      "at most keeps lines from crossing.",
           .required = true})
      .metres("scale", &sim::Meander::scale_m,
              {.unit = kMetres, .limits = kMore, .meaning = "The longest waves.", .required = true})
      .whole("octaves", &sim::Meander::octaves,
             {.unit = "octaves",
              .limits = {1.0, 16.0},
              .meaning =
                  "Each with waves half as long and a quarter as wide; those that the spacing cannot show "
                  "are left out."})
      .shared();
}

std::shared_ptr<const rules::Table> coverKeys() {
  return TableOf<CoverSpec>()
      .colour("colour", &CoverSpec::colour, {.meaning = "What it looks like.", .required = true})
      .metres("above", &CoverSpec::above_m,
              {.unit = kMetres, .limits = kHeight, .meaning = "Where it lies higher than this."})
      .metres("below", &CoverSpec::below_m,
              {.unit = kMetres, .limits = kHeight, .meaning = "Where it lies lower than this."})
      .number("steeper", &CoverSpec::steeper_deg,
              {.unit = kDegrees, .limits = kSteep, .meaning = "Where it is steeper than this."})
      .number("flatter", &CoverSpec::flatter_deg,
              {.unit = kDegrees, .limits = kSteep, .meaning = "Where it is less steep than this."})
      .metres("soft", &CoverSpec::soft_m,
              {.unit = kMetres,
               .limits = kLength,
               .meaning = "Over so much of height it comes and goes in colour."})
      .flag("on_lines", &CoverSpec::on_lines,
            {.meaning = "On the lines alone, as wide as they are; nothing flows where they lie highest."})
      .shared();
}

}  // namespace

std::shared_ptr<const rules::Table> heightsKeys() {
  return TableOf<HeightsSpec>()
      .text("plants", &HeightsSpec::plants,
            {.meaning = "Whose skeletons, seen from above, are the lines: one of the plants, by its name.",
             .required = true,
             .most = 100})
      .outline("over", &HeightsSpec::over_m,
               {.unit = kMetres,
                .limits = kCoordinate,
                .meaning = "Two corners [x, z] of the land; without it, the world's.",
                .most = 2})
      .metres("spacing", &HeightsSpec::spacing_m,
              {.unit = kMetres,
               .limits = kMore,
               .meaning = "Between samples; without it, a thousandth of the longer side."})
      .flag("falls", [](auto& h) -> auto& { return h.law.falls; },
            {.meaning = "Lines lie highest: they fall from the seeds, and land falls beside them. Otherwise "
                        "all rises."})
      .metres("base", [](auto& h) -> auto& { return h.law.line.base_m; },
              {.unit = kMetres, .limits = kHeight, .meaning = "The height of the seeds."})
      .number("grade", [](auto& h) -> auto& { return h.law.line.grade; },
              {.unit = "metres a metre",
               .limits = {0.0, 100.0},
               .meaning = "How steep a line is that one tip drains into."})
      .number("concavity", [](auto& h) -> auto& { return h.law.line.concavity; },
              {.unit = "exponent",
               .limits = {0.0, 10.0},
               .meaning = "One that drains n tips is n^-concavity times as steep (Flint's law)."})
      .number("order_share", [](auto& h) -> auto& { return h.law.line.order_share; },
              {.unit = "factor",
               .limits = {0.0, 100.0, true},
               .meaning = "How many times as steep lines are with each order of branching."})
      .number("slope", [](auto& h) -> auto& { return h.law.flank.slope; },
              {.unit = "metres a metre",
               .limits = {0.0, 100.0, true},
               .meaning = "How steep land is beside lines, far from them."})
      .metres(
          "ease", [](auto& h) -> auto& { return h.law.flank.ease_m; },
          {.unit = kMetres,
           .limits = kLength,
           .meaning = "So far from a line land has risen by half of what slope alone makes: wide valleys."})
      .metres(
          "most", [](auto& h) -> auto& { return h.law.flank.most_m; },
          {.unit = kMetres,
           .limits = kMore,
           .meaning = "So much it rises beside a line far from all: it levels off. Without it, it goes on."})
      .metres("width", [](auto& h) -> auto& { return h.law.width_m; },
              {.unit = kMetres,
               .limits = kLength,
               .meaning = "Of a line that drains one tip, level from rim to rim; of n tips: n^0.5 times."})
      .metres("floor", [](auto& h) -> auto& { return h.law.floor_m; },
              {.unit = kMetres, .limits = kHeight, .meaning = "No land is lower: a sea, or a plain."})
      .section("meander", &HeightsSpec::meander, meanderKeys(),
               {.meaning = "Lines stray from their straight ways in plan, those that lie together together."},
               "amplitude")
      .whole("iteration", &HeightsSpec::iteration,
             {.unit = "iterations",
              .limits = {1.0, 100'000.0},
              .meaning = "Of what stands after so many iterations; without it, at the end."})
      .section(
          "noise", [](auto& h) -> auto& { return h.law.noise; }, noiseKeys(),
          {.meaning = "Sparse convolution noise: fine erosion, which leaves the lines alone."}, "amplitude")
      .list<CoverSpec>(
          "cover", rules::Kind::named, &HeightsSpec::cover, coverKeys(),
          {.meaning = "Colours by height and slope, each over those before it; their names become "
                      "regions.",
           .most = 100})
      .shared();
}

void checkHeights(const Scene& scene, const rules::Check::Given&, const rules::Check::Complain& complain) {
  std::vector<std::string> names;
  for (const PlantSpec& plant : scene.plants) names.push_back(plant.name);
  for (const HeightsSpec& heights : scene.heights) {
    const std::string path = "heights." + heights.name;
    if (const std::string wrong = notCalled("plant", heights.plants, names); !wrong.empty())
      complain(path + ".plants", wrong);
    if (heights.over_m.size() == 1) {
      complain(path + ".over", "land over one corner; expected two, [[x, z], [x, z]]");
    } else if (heights.over_m.size() == 2 &&
               (heights.over_m[0].x == heights.over_m[1].x || heights.over_m[0].y == heights.over_m[1].y)) {
      complain(path + ".over", "land without an inside; expected corners that differ in x and in z");
    }
    for (const CoverSpec& cover : heights.cover) {
      const std::string at = path + ".cover." + cover.name;
      if (cover.above_m && cover.below_m && *cover.above_m >= *cover.below_m)
        complain(at + ".below",
                 "nothing lies above the one and below the other; expected below to be more than above");
      if (cover.steeper_deg && cover.flatter_deg && *cover.steeper_deg >= *cover.flatter_deg)
        complain(at + ".flatter",
                 "nothing is steeper than the one and flatter than the other; expected flatter to be more "
                 "than steeper");
    }
  }
}

void checkImageHeights(const Scene& scene, const rules::Check::Given&,
                       const rules::Check::Complain& complain) {
  std::vector<std::string> names;
  for (const HeightsSpec& heights : scene.heights) names.push_back(heights.name);
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const ImageSpec& image = scene.images[i];
    const bool shows = std::find(image.show.begin(), image.show.end(), "heights") != image.show.end();
    const std::string path = fmt::format("images[{}]", i);
    if (!image.heights.empty() && !shows)
      complain(path + ".heights", "heights that are not shown; expected show: [heights, ...] too");
    if (!shows) continue;
    if (names.empty()) {
      complain(path + ".show", "heights of a scene that has none; expected some under 'heights'");
    } else if (const std::string wrong = notCalled("heights", image.heights, names);
               !image.heights.empty() && !wrong.empty()) {
      complain(path + ".heights", wrong);
    }
  }
}

}  // namespace espalier::scenes
