#include "rules/language/element_keys.h"

#include "rules/language/emission_keys.h"
#include "rules/language/key_builder.h"

namespace espalier::rules {
namespace {

const char* const kWidths = "voxel widths";
const char* const kTurn = "degrees";
constexpr Limits kHalfTurn{0.0, 180.0};
constexpr Limits kMostTrials{1.0, 10'000.0};  // as many as a random key tells apart

std::shared_ptr<const Table> phyllotaxisKeys() {
  return TableOf<Phyllotaxis>()
      .number(
          "angle", &Phyllotaxis::angle_deg,
          {.unit = kTurn,
           .limits = {0.0, 360.0},
           .meaning =
               "About the stem, from one place to the next: 137.5 is the golden angle, 180 makes two rows."})
      .distance("spacing", &Phyllotaxis::spacing,
                {.unit = kWidths,
                 .limits = {0.0, 1000.0, true},
                 .meaning = "Along the limb, from one place to the next."})
      .whole("whorl", &Phyllotaxis::whorl,
             {.unit = "elements", .limits = {1.0, 16.0}, .meaning = "At one place, evenly about the stem."})
      .value("pitch", &Phyllotaxis::pitch_deg,
             {.unit = kTurn,
              .limits = kHalfTurn,
              .meaning = "Between an element and the way that its stem goes; more than 90 hangs back."})
      .shared();
}

std::shared_ptr<const Table> variationKeys() {
  using sim::ColourVariation;
  const auto weight = [](std::string meaning) {
    return About{.unit = "weight", .limits = {0.0, 3.0}, .meaning = std::move(meaning)};
  };
  return TableOf<ColourVariation>()
      .number("chance", &ColourVariation::by_chance, weight("How far each has a shade and a hue of its own."))
      .number("age", &ColourVariation::by_age, weight("How much lighter the young ones are."))
      .number("light", &ColourVariation::by_light,
              weight("How much brighter those are that grew in the light."))
      .number("height", &ColourVariation::by_height,
              weight("How far the higher ones of a plant go from green to gold."))
      .shared();
}

}  // namespace

namespace {

std::shared_ptr<const Table> roughnessKeys() {
  return TableOf<Roughness>()
      .number("hurst", &Roughness::hurst,
              {.unit = "exponent",
               .limits = {0.01, 0.99},
               .meaning = "Hurst exponent of the noise: 0.5 is a random walk, less is more jagged, more is "
                          "smoother."})
      .distance("amplitude", &Roughness::amplitude,
                {.unit = kWidths,
                 .limits = {0.0, 1e6},
                 .meaning = "How far ways stray along each axis over a stretch, in the mean of squares."})
      .distance("over", &Roughness::over,
                {.unit = kWidths,
                 .limits = {0.0, 1e6, true},
                 .meaning = "How long that stretch is; over others they stray by the exponent."})
      .distance("detail", &Roughness::detail,
                {.unit = kWidths,
                 .limits = {0.0, 1000.0, true},
                 .meaning = "Length of the straight pieces that rough ways are made of."})
      .shared();
}

}  // namespace

std::shared_ptr<const Table> stemKeys() {
  using Forks = sim::StemForm::Forks;
  using By = sim::StemGirth::By;
  return TableOf<Stem>()
      .colour("colour", &Stem::colour, {.meaning = "Colour of the bark."})
      .colour(
          "shoots", &Stem::shoots,
          {.meaning = "Colour of what grew last, which fades into that of the bark with age; without it a "
                      "little green."})
      .section("emits", &Stem::emits, stemEmissionKeys(),
               {.meaning = "Light that it sends out, and with interreflection onto others too; a colour "
                           "stands for its own."},
               "colour")
      .number(
          "opacity", &Stem::alpha,
          {.unit = "share",
           .limits = {0.0, 1.0},
           .meaning =
               "How much it hides of what is behind it, in pictures and models: 0.3 is ice, 1 hides all."})
      .file(
          "texture", &Stem::texture,
          {.meaning = "What is painted on it, side by side: bark, which is drawn in `colour`, or a PNG file "
                      "beside this one that tiles."})
      .distance(
          "radius", &Stem::radius,
          {.unit = kWidths, .limits = {0.0, 100.0, true}, .meaning = "Radius of a twig that does not fork."})
      .choice<By>("by", &Stem::by, {{"pipes", By::pipes}, {"age", By::age}},
                  {.meaning = "What makes stems thick: one pipe to each of their tips, or their age."})
      .number("exponent", &Stem::exponent,
              {.unit = "exponent",
               .limits = {1.0, 10.0},
               .meaning = "By pipes: a stem's radius to this power is the sum of those that it carries; 2 is "
                          "Leonardo's rule, 3 Murray's law."})
      .distance("thickens", &Stem::thickens,
                {.unit = kWidths,
                 .limits = {0.0, 100.0},
                 .meaning = "By age: by how much a radius grows in each iteration."})
      .distance("thickest", &Stem::thickest,
                {.unit = kWidths,
                 .limits = {0.0, 1000.0, true},
                 .meaning = "Greatest radius of any stem. Without it trunks are as thick as they come."})
      .number("order_share", &Stem::order_share,
              {.unit = "factor",
               .limits = {0.0, 1.0, true},
               .meaning = "Radii are multiplied by it for each order of branching: by less than 1, side "
                          "limbs are slender."})
      .section("rough", &Stem::rough, roughnessKeys(),
               {.meaning = "Ways stray by fractional Brownian noise, once they have grown; a length stands "
                           "for its amplitude."},
               "amplitude")
      .choice<Forks>(
          "forks", &Stem::forks, {{"grown", Forks::grown}, {"murray", Forks::murray}},
          {.meaning = "Once it has grown: as it forked; or turned to the angles at which vessels of "
                      "such radii cost least."})
      .shared();
}

std::shared_ptr<const Table> elementKeys() {
  return TableOf<Element>()
      .name("name", &Element::name, {.meaning = "What it is called in the model and in reports."})
      .whole("trials", &Element::trials,
             {.unit = "trials",
              .limits = kMostTrials,
              .meaning = "Attempts to place it before giving up.",
              .greene = "number_of_trials"})
      .value("per_segment", &Element::per_segment,
             {.unit = "elements",
              .limits = {0.0, 100.0},
              .meaning = "Expected number on a segment at the least exposure.",
              .greene = "expected_frequency"})
      .custom(
          "size", Kind::size,
          [](Element& e, const Datum& d) {
            const auto& size = std::get<Length>(d);
            e.size = size.value;
            e.size_metres = size.metres;
          },
          [](const Element& e) {
            return Datum{Length{e.size, e.size_metres}};
          },
          {.unit = "factor",
           .limits = {0.0, 100.0, true},
           .meaning = "Scale of the polygons at the least exposure; a length is what 1 of their numbers "
                      "measures."})
      .value("face", &Element::face,
             {.unit = "weight",
              .limits = {0.0, 1.0},
              .meaning = "How far the face turns from the stem's own way to the open and the sky."})
      .choice<Pose>(
          "pose", &Element::pose,
          {{"free", Pose::free},
           {"hang", Pose::hang},
           {"stand", Pose::stand},
           {"light", Pose::light},
           {"surface", Pose::surface},
           {"aside", Pose::aside}},
          {.meaning = "Upright, hanging, facing the brightest sky, or flat on a surface: along its limb, or "
                      "aside by pitch."})
      .colour("colour", &Element::colour, {.meaning = "Colour of its polygons."})
      .section("emits", &Element::emits, emissionKeys(),
               {.meaning = "Light that it sends out, and with interreflection onto others too; a colour "
                           "stands for its own."},
               "colour")
      .number(
          "opacity", &Element::alpha,
          {.unit = "share",
           .limits = {0.0, 1.0},
           .meaning =
               "How much it hides of what is behind it, in pictures and models: 0.3 is ice, 1 hides all."})
      .custom(
          "polygons", Kind::polygons,
          [](Element& e, const Datum& d) {
            const auto& polygons = std::get<Polygons>(d);
            e.polygons = polygons.corners;
            e.polygons_metres = polygons.metres;
          },
          [](const Element& e) {
            return Datum{Polygons{e.polygons, e.polygons_metres}};
          },
          {.unit = kWidths,
           .limits = {-1000.0, 1000.0},
           .meaning = "Flat polygons by their corners; attached at [0, 0, 0], growing along +y, facing +z.",
           .greene = "model, polygon",
           .most = 256})
      .distance("thick", &Element::thick,
                {.unit = kWidths,
                 .limits = {0.0, 1000.0},
                 .meaning = "How far up along +z its polygons are made a body; in their own unit."})
      .value("share", &Element::share,
             {.unit = "weight",
              .limits = {0.0, 1000.0},
              .meaning = "In diffusion: how often it is tried before the others."})
      .custom(
          "petiole", Kind::length, [](Element& e, const Datum& d) { e.petiole = std::get<Length>(d); },
          [](const Element& e) { return Datum{e.petiole}; },
          {.unit = kWidths,
           .limits = {0.0, 1000.0},
           .meaning = "A stalk, from the stem to [0, 0, 0] of the polygons."})
      .flag("crosses", &Element::crosses,
            {.meaning = "It may cross elements and limbs, as sprays do that are mostly holes; it still stays "
                        "out of the scene."})
      .section("phyllotaxis", &Element::phyllotaxis, phyllotaxisKeys(),
               {.meaning = "They stand along their limb in an order, in place of per_segment by chance."})
      .file("texture", &Element::texture,
            {.meaning = "Painted on the polygons, which it cuts out: a PNG file, or ovate, ivy, palmate, "
                        "needles, branch, blossom."})
      .file("from", &Element::from,
            {.meaning = "In place of a texture a scene, which is run first: one of its images is painted."})
      .name("product", &Element::product,
            {.meaning = "Which of that scene's images; without it, the only one."})
      .section("varies", &Element::varies, variationKeys(),
               {.meaning = "How far their colours differ: 0 not at all, 1 as leaves do."})
      .oneOf({"polygons", "texture", "from"})
      .shared();
}

}  // namespace espalier::rules
