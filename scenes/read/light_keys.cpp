#include "scenes/read/light_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "rules/language/key_builder.h"
#include "scenes/lights.h"
#include "scenes/read/units.h"
#include "sim/base/error.h"
#include "sim/light/interreflection.h"

namespace espalier::scenes {
namespace {

using rules::Table;
using rules::TableOf;
using Given = rules::Check::Given;
using Complain = rules::Check::Complain;

const char* const kHours = "hours";

std::shared_ptr<const Table> placeKeys() {
  using Place = SunPlace;
  return TableOf<Place>()
      .number("latitude", &Place::latitude_deg,
              {.unit = kDegrees, .limits = {-90.0, 90.0}, .meaning = "North is positive.", .required = true})
      .number("longitude", &Place::longitude_deg,
              {.unit = kDegrees, .limits = {-180.0, 180.0}, .meaning = "East is positive.", .required = true})
      .number("utc_offset", &Place::utc_offset_h,
              {.unit = kHours,
               .limits = {-14.0, 14.0},
               .meaning = "What the local clock shows more than UTC: 1 in Zurich's winter, -5 in New York's.",
               .required = true})
      .shared();
}

std::shared_ptr<const Table> datesKeys() {
  using Dates = SunSpec::Dates;
  return TableOf<Dates>()
      .date("from", &Dates::from, {.meaning = "The first day.", .required = true})
      .date("to", &Dates::to, {.meaning = "The last day.", .required = true})
      .shared();
}

std::shared_ptr<const Table> hoursKeys() {
  using Hours = SunSpec::Hours;
  return TableOf<Hours>()
      .number("from", &Hours::from,
              {.unit = kHours, .limits = {0.0, 24.0}, .meaning = "The first of each day."})
      .number("to", &Hours::to, {.unit = kHours, .limits = {0.0, 24.0}, .meaning = "The last of each day."})
      .shared();
}

/// The hours of a day between which the sun is up, to five minutes.
std::optional<SunSpec::Hours> hoursOfSun(const SunSpec& spec) {
  std::optional<SunSpec::Hours> up;
  for (int i = 0; i < 24 * 12; ++i) {
    const double hour = i / 12.0;
    if (sunDirection(spec, hour).y <= 0.0) continue;
    if (!up) up = SunSpec::Hours{hour, hour};
    up->to = hour;
  }
  return up;
}

bool showsShadows(ImageKind kind) {
  return kind == ImageKind::shadow_matte || kind == ImageKind::first_pass || kind == ImageKind::volume ||
         kind == ImageKind::vines;
}

void checkShadowHour(const Scene& scene, const Given& given, const Complain& complain) {
  const bool asked = given("sun.shadow_hour");
  const bool needed = asked || std::any_of(scene.images.begin(), scene.images.end(),
                                           [](const auto& image) { return showsShadows(image.kind); });
  if (!needed || sunDirection(scene.sun, scene.sun.shadow_hour).y > 0.0) return;
  const auto up = hoursOfSun(scene.sun);
  const auto day = scene.sun.place ? sim::written(scene.sun.firstDay()) : "the arc";
  complain(
      asked ? "sun.shadow_hour" : "sun",
      fmt::format("the sun is not up at {:g} h on {}, where the shadows of pictures are drawn; expected {}",
                  scene.sun.shadow_hour, day,
                  up ? fmt::format("shadow_hour: {:.1f} to {:.1f}", up->from + 0.05, up->to - 0.05)
                     : "a first day with sun"));
}

/// The day, where there is a place. True if there is nothing to complain of.
bool checkDays(const SunSpec& sun, const Complain& complain) {
  if (sun.date && sun.dates) {
    complain("sun.dates", "both date and dates are given; expected one of them");
  } else if (!sun.date && !sun.dates) {
    complain(
        "sun.place",
        "a place without a day; expected date: 2026-06-21, or dates: {from: 2026-03-21, to: 2026-09-23}");
  } else if (sun.dates && sun.dates->to < sun.dates->from) {
    complain("sun.dates.to", fmt::format("the last day is {} and the first {}; expected it not to be before",
                                         sim::written(sun.dates->to), sim::written(sun.dates->from)));
  } else if (sun.hours.from >= sun.hours.to) {
    complain("sun.hours", fmt::format("hours from {:g} to {:g}; expected the first to be before the last",
                                      sun.hours.from, sun.hours.to));
  } else {
    return true;
  }
  return false;
}

}  // namespace

namespace {

std::shared_ptr<const Table> backgroundKeys() {
  using Sky = BackgroundSpec::Kind;
  const auto band = TableOf<BackgroundSpec>()
                        .number("brightness", [](auto& b) -> auto& { return b.sun.brightness; },
                                {.unit = "factor",
                                 .limits = {0.0, 1000.0},
                                 .meaning = "In the band's middle, times the mean of the sky."})
                        .number("width", [](auto& b) -> auto& { return b.sun.width_deg; },
                                {.unit = kDegrees,
                                 .limits = {0.0, 180.0, true},
                                 .meaning = "Across the band; less and less bright towards its rims."})
                        .shared();
  return TableOf<BackgroundSpec>()
      .choice<Sky>("kind", &BackgroundSpec::kind,
                   {{"weighting", Sky::weighting},
                    {"uniform", Sky::uniform},
                    {"cie_overcast", Sky::cie_overcast},
                    {"gradient", Sky::gradient},
                    {"picture", Sky::picture}},
                   {.meaning = "How bright its parts are: as sky.weighting means, alike, the CIE overcast "
                               "sky, from the zenith to the horizon, or by a picture."})
      .number("horizon", &BackgroundSpec::horizon,
              {.unit = "factor",
               .limits = {0.0, 100.0},
               .meaning = "Of a gradient: brightness at the horizon, over that of the zenith."})
      .file("file", &BackgroundSpec::file,
            {.meaning =
                 "Of a picture, twice as wide as high: all around from left to right, straight up at the "
                 "top and straight down at the bottom; .exr, .hdr, .png or .jpg."})
      .number("turn", &BackgroundSpec::turn_deg,
              {.unit = kDegrees,
               .limits = {-360.0, 360.0},
               .meaning = "The compass way of the picture's middle: 0 is -z, 90 is +x."})
      .section("sun", std::identity{}, band,
               {.meaning = "A band of light along the sun's way; a number stands for its brightness."},
               "brightness")
      .shared();
}

}  // namespace

std::shared_ptr<const Table> skyKeys() {
  return TableOf<SkySpec>()
      .choice<sim::Weighting>("weighting", &SkySpec::weighting,
                              {{"uniform", sim::Weighting::uniform},
                               {"cosine", sim::Weighting::cosine},
                               {"cie_overcast", sim::Weighting::cie_overcast}},
                              {.meaning = "Each part of the sky counts by its solid angle (Greene's way), "
                                          "also by the cosine with what it lights (the view factor), or "
                                          "also by the brightness of the CIE overcast sky."})
      .number("accuracy", &SkySpec::accuracy,
              {.limits = {0.001, 0.5},
               .meaning = "Standard error of sky_exposure, from which the number of directions follows; "
                          "without it 0.003 in maps of a scene's light, and 0.005 where plants grow."})
      .whole("directions", &SkySpec::directions,
             {.unit = "directions",
              .limits = {1.0, sim::kMostSkyDirections},
              .meaning = "Directions over the sky's hemisphere, instead of an accuracy."})
      .choice<Sampling>("sampling", &SkySpec::sampling,
                        {{"lattice", Sampling::lattice}, {"random", Sampling::random}},
                        {.meaning = "The same directions from everywhere, or Greene's way: rays at random "
                                    "from each place, for comparison."})
      .whole("rays", &SkySpec::rays,
             {.unit = "rays",
              .limits = {1.0, sim::kMostSkyDirections},
              .meaning = "From each place, of sampling: random."})
      .number(
          "brightness", &SkySpec::brightness,
          {.unit = "factor",
           .limits = {0.0, 10.0},
           .meaning = "Of its light in images of vines: 1 is a clear morning, 0.03 dusk. Exposures do not "
                      "hang on it."})
      .colour("tint", &SkySpec::tint, {.meaning = "Colour that this light is multiplied by."})
      .section("background", &SkySpec::background, backgroundKeys(),
               {.meaning = "The sky behind what plants see of it that turn to its brightest part; exposures "
                           "do not hang on it."})
      .shared();
}

std::shared_ptr<const Table> sunKeys() {
  return TableOf<SunSpec>()
      .number("tilt", &SunSpec::tilt_deg,
              {.unit = kDegrees,
               .limits = {0.0, 85.0},
               .meaning = "Of the arc: how far the sun's half circle leans from the vertical."})
      .number("toward", &SunSpec::toward_deg,
              {.unit = kDegrees,
               .limits = {-360.0, 360.0},
               .meaning = "Of the arc: the compass way to which it leans: 0 is -z, 90 is +x, 180 is +z."})
      .whole("samples", &SunSpec::samples,
             {.unit = "directions",
              .limits = {1.0, 4096.0},
              .meaning = "Of the arc: places of the sun along its way."})
      .section("place", &SunSpec::place, placeKeys(), {.meaning = "Where on earth: a real sun."})
      .date("date", &SunSpec::date, {.meaning = "Of the real sun: the day."})
      .section("dates", &SunSpec::dates, datesKeys(), {.meaning = "Of the real sun: every day of a range."})
      .section("hours", &SunSpec::hours, hoursKeys(),
               {.meaning = "Of the real sun: the part of each day that counts, by the local clock."})
      .number("step", &SunSpec::step_min,
              {.unit = "minutes",
               .limits = {1.0, 1440.0},
               .meaning = "Of the real sun: time from one of its places to the next."})
      .choice<sim::SunWeighting>(
          "weighting", &SunSpec::weighting,
          {{"even", sim::SunWeighting::even}, {"sine", sim::SunWeighting::sine}},
          {.meaning = "Of the real sun: whether its hours count alike in sun_exposure, or by the sine of its "
                      "elevation, as its beam lights level ground."})
      .number("north", &SunSpec::north_deg,
              {.unit = kDegrees,
               .limits = {-360.0, 360.0},
               .meaning = "Of the real sun: the compass way of true north in the model: 0 is -z, 90 is +x."})
      .number("accuracy", &SunSpec::accuracy_deg,
              {.unit = kDegrees,
               .limits = {0.1, 10.0},
               .meaning = "How far a direction may lie from the place of the sun for which it stands."})
      .number("brightness", &SunSpec::brightness,
              {.unit = "factor",
               .limits = {0.0, 10.0},
               .meaning = "Of its light in images of vines: 1 is a clear morning, 0 none. Exposures do not "
                          "hang on it."})
      .number("shadow_hour", &SunSpec::shadow_hour,
              {.unit = kHours,
               .limits = {0.0, 24.0},
               .meaning = "Time of the (first) day at which pictures draw sharp shadows. On the arc 6 is "
                          "sunrise, 12 its top and 18 sunset."})
      .shared();
}

std::shared_ptr<const Table> interreflectionKeys() {
  using Spec = InterreflectionSpec;
  return TableOf<Spec>()
      .whole("passes", &Spec::passes,
             {.unit = "passes",
              .limits = {1.0, sim::kMostPasses},
              .meaning = "At most: on the first, rays that meet something bring nothing; 2 is one bounce."})
      .number("tolerance", &Spec::tolerance,
              {.limits = {0.0, 1.0},
               .meaning = "They end when no surface changes by more of the brightest; at 0 all are made."})
      .whole("directions", &Spec::directions,
             {.unit = "directions",
              .limits = {1.0, sim::kMostSkyDirections},
              .meaning = "Over each half of the sphere, above the horizon and below."})
      .choice<BounceWeighting>(
          "weighting", &Spec::weighting,
          {{"lambert", BounceWeighting::lambert}, {"equal", BounceWeighting::equal}},
          {.meaning = "By the cosine with the surface's normal, or all directions before "
                      "it alike, as Greene had them."})
      .shared();
}

void checkSky(const Scene& scene, const Given& given, const Complain& complain) {
  const bool random = scene.sky.sampling == Sampling::random;
  if (!random && given("sky.rays"))
    complain("sky.rays", "rays mean nothing to sampling: lattice; expected accuracy, or sampling: random");
  for (const char* key : {"accuracy", "directions"}) {
    const std::string path = std::string("sky.") + key;
    if (random && given(path))
      complain(path, fmt::format("{} means nothing to sampling: random; expected rays", key));
  }
  if (random && scene.interreflection) {
    complain("interreflection",
             "light bounces along lattice directions, not along sampling: random; expected one of the two");
  }
  if (given("sky.accuracy") && given("sky.directions")) {
    complain("sky.directions", "both accuracy and directions are given; expected one of them");
    return;
  }
  try {
    if (scene.sky.accuracy) sim::directionsFor(scene.sky.weighting, *scene.sky.accuracy);
  } catch (const sim::InputError& error) {
    complain("sky.accuracy", error.what());
  }
}

void checkBackground(const Scene& scene, const Given& given, const Complain& complain) {
  using Sky = BackgroundSpec::Kind;
  const BackgroundSpec& background = scene.sky.background;
  for (const char* const key : {"file", "turn"}) {
    const auto path = std::string("sky.background.") + key;
    if (given(path) && background.kind != Sky::picture)
      complain(path, fmt::format("{} belongs to kind: picture; expected that kind, or no {}", key, key));
  }
  if (background.kind == Sky::picture && background.file.empty())
    complain("sky.background", "kind: picture without a file; expected file: SKY.exr");
  if (given("sky.background.horizon") && background.kind != Sky::gradient)
    complain("sky.background.horizon",
             "horizon belongs to kind: gradient; expected that kind, or no horizon");
  if (given("sky.background.sun.width") && background.sun.brightness == 0.0)
    complain("sky.background.sun.width", "a band without brightness; expected brightness: 3 beside it");
}

void checkSun(const Scene& scene, const Given& given, const Complain& complain) {
  const SunSpec& sun = scene.sun;
  bool good = true;
  for (const char* key : {"tilt", "toward", "samples"}) {
    const std::string path = std::string("sun.") + key;
    if (!sun.place || !given(path)) continue;
    complain(path, fmt::format("{} belongs to the inclined arc and place to the real sun; expected one of "
                               "the two suns",
                               key));
    good = false;
  }
  for (const char* key : {"date", "dates", "hours", "step", "weighting", "north"}) {
    const std::string path = std::string("sun.") + key;
    if (sun.place || !given(path)) continue;
    complain(path, fmt::format("{} belongs to a real sun; expected place: {{latitude: 47.4, longitude: 8.5, "
                               "utc_offset: 1}} beside it",
                               key));
    good = false;
  }
  if (!good || (sun.place && !checkDays(sun, complain))) return;
  try {
    makeSun(sun);
    checkShadowHour(scene, given, complain);
  } catch (const sim::InputError& error) {
    complain(sun.place ? "sun.place" : "sun", error.what());
  }
}

}  // namespace espalier::scenes
