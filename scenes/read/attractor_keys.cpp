#include "scenes/read/attractor_keys.h"

#include "rules/language/envelope_keys.h"
#include "rules/language/key_builder.h"
#include "scenes/read/units.h"
#include "scenes/scene.h"

namespace espalier::scenes {
namespace {

using rules::TableOf;

std::shared_ptr<const rules::Table> pictureKeys() {
  const auto corner = [](const char* meaning) {
    return rules::About{.unit = kMetres, .limits = kCoordinate, .meaning = meaning, .required = true};
  };
  return TableOf<PictureSpec>()
      .file("file", &PictureSpec::file,
            {.meaning =
                 "Its file: .png, .jpg, .exr or .hdr. What has half the value of another pixel is half as "
                 "dense."})
      .file("from", &PictureSpec::from,
            {.meaning = "Or another scene, which is run first: it is one of its images."})
      .name("product", &PictureSpec::product,
            {.meaning = "Which of that scene's images; without it, the only one."})
      .place("top_left", &PictureSpec::top_left_m, corner("Where its upper left corner lies."))
      .place("top_right", &PictureSpec::top_right_m, corner("Where its upper right corner lies."))
      .place("bottom_left", &PictureSpec::bottom_left_m, corner("Where its lower left corner lies."))
      .oneOf({"file", "from"})
      .shared();
}

}  // namespace

std::shared_ptr<const rules::Table> attractorKeys() {
  TableOf<AttractorsSpec> table;
  rules::addSolids(table, &AttractorsSpec::solid);
  table
      .place("at", &AttractorsSpec::at_m,
             {.unit = kMetres,
              .limits = kCoordinate,
              .meaning = "The solid's foot, the lowest point of its axis: the middle of a box's floor."})
      .text("surface", &AttractorsSpec::surface,
            {.meaning = "Or the name of one of the meshes: on its surface, even by area.", .most = 100})
      .text("inside", &AttractorsSpec::inside,
            {.meaning = "Or the name of one of the meshes: in its inside, even by volume.", .most = 100})
      .file(
          "points", [](auto& a) -> auto& { return a.table.file; },
          {.meaning = "Or a table of points, .csv: x, y, z in metres on each line, and perhaps their type."})
      .whole("type", [](auto& a) -> auto& { return a.table.type; },
             {.limits = kPointTypes, .meaning = "Those points of the table that are of this type alone."})
      .section(
          "picture", &AttractorsSpec::picture, pictureKeys(),
          {.meaning = "Or a picture, laid in the scene by three corners: in it, the denser the brighter."});
  rules::addStrewing(table, &AttractorsSpec::strewing);
  return table
      .metres("spacing", &AttractorsSpec::spacing_m,
              {.unit = kMetres,
               .limits = {0.0, 1e6, true},
               .meaning = "Least between any two on a surface, or in a picture where it is brightest; "
                          "without a count as many as find room."})
      .whole("waves", &AttractorsSpec::waves,
             {.unit = "waves",
              .limits = {1.0, 12.0},
              .meaning = "They come in so many, from sparse to dense: each keeps half the spacing of the one "
                         "before it."})
      .shared();
}

}  // namespace espalier::scenes
