#include "scenes/read/field_keys.h"

#include "rules/language/key_builder.h"
#include "scenes/read/units.h"
#include "scenes/scene.h"

namespace espalier::scenes {
namespace {

using rules::GuideAxis;
using rules::GuidePoint;
using rules::Limits;
using rules::TableOf;

constexpr Limits kAngle{-36'000.0, 36'000.0};
constexpr Limits kStrength{0.0, 1000.0};

std::shared_ptr<const rules::Table> boxKeys() {
  using Box = std::array<sim::Vec3, 2>;
  return TableOf<Box>()
      .place("min", [](auto& b) -> auto& { return b[0]; },
             {.unit = kMetres, .limits = kCoordinate, .meaning = "Its least corner.", .required = true})
      .place("max", [](auto& b) -> auto& { return b[1]; },
             {.unit = kMetres, .limits = kCoordinate, .meaning = "Its greatest corner.", .required = true})
      .shared();
}

std::shared_ptr<const rules::Table> pointKeys() {
  return TableOf<GuidePoint>()
      .place("at", &GuidePoint::at,
             {.unit = kMetres, .limits = kCoordinate, .meaning = "Where it is.", .required = true})
      .metres("radius", &GuidePoint::radius,
              {.unit = kMetres,
               .limits = {0.0, 1e6, true},
               .meaning = "How far it reaches: less and less towards there.",
               .required = true})
      .number("angle", &GuidePoint::angle_deg,
              {.unit = kDegrees, .limits = kAngle, .meaning = "The angle there, in place of the field's."})
      .number("strength", &GuidePoint::strength,
              {.unit = "factor", .limits = kStrength, .meaning = "The strength there."})
      .shared();
}

}  // namespace

std::shared_ptr<const rules::Table> fieldKeys() {
  return TableOf<FieldSpec>()
      .number(
          "angle", [](auto& f) -> auto& { return f.guide.angle_deg; },
          {.unit = kDegrees,
           .limits = kAngle,
           .meaning = "By which ways wind about the axis from the start to the farthest attractor; below 0 "
                      "the other way."})
      .number("strength", [](auto& f) -> auto& { return f.guide.strength; },
              {.unit = "factor",
               .limits = kStrength,
               .meaning = "How much it bends, against the pull of attractors as 1; 0 is plain colonization."})
      .choice<GuideAxis>(
          "axis", [](auto& f) -> auto& { return f.guide.axis; },
          {{"direction", GuideAxis::direction},
           {"node_normal", GuideAxis::node_normal},
           {"attractor_normal", GuideAxis::attractor_normal},
           {"grid", GuideAxis::grid}},
          {.meaning = "What it winds about: one direction, the normal of the attractor nearest "
                      "to the node, or of that which pulls it, or the vectors of a file."})
      .point(
          "direction", [](auto& f) -> auto& { return f.guide.direction; },
          {.unit = "vector", .limits = {-1e6, 1e6}, .meaning = "Of axis: direction; its length is nothing."})
      .file(
          "file", &FieldSpec::file,
          {.meaning = "Of axis: grid: a volume, .vdb, in world metres; where it has no vector, the field is "
                      "none."})
      .text("grid", &FieldSpec::grid,
            {.meaning = "Of axis: grid: which of the file's grids of vectors; without it, the only one.",
             .most = 100})
      .flag("follow_normal", [](auto& f) -> auto& { return f.guide.follows_normal; },
            {.meaning = "The strength is multiplied by the length of the axis or the normal."})
      .wholeRange("orders", &FieldSpec::order_first, &FieldSpec::order_last,
                  {.unit = "orders",
                   .limits = {0.0, 1000.0},
                   .meaning = "Of which limbs: 0 the trunk, 1 its branches, and so on, from and to."})
      .section("box", [](auto& f) -> auto& { return f.guide.box; }, boxKeys(),
               {.meaning = "Holds in here alone."})
      .text("within", &FieldSpec::within,
            {.meaning = "And in the inside of this one of the meshes alone.", .most = 100})
      .list<GuidePoint>("points", rules::Kind::entries, &FieldSpec::points, pointKeys(),
                        {.meaning = "Places about which it is another one.", .most = 1000})
      .shared();
}

}  // namespace espalier::scenes
