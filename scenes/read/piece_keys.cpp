#include "scenes/read/piece_keys.h"

#include <fmt/format.h>

#include <algorithm>

#include "rules/language/key_builder.h"
#include "scenes/problem.h"
#include "scenes/read/units.h"
#include "sim/tile/build_world.h"

namespace espalier::scenes {
namespace {

using rules::Check;
using rules::TableOf;

constexpr rules::Limits kLengths{0.0, 1e6, true};

std::shared_ptr<const rules::Table> roughKeys() {
  return TableOf<sim::CutRoughness>()
      .metres("amplitude", &sim::CutRoughness::amplitude_m,
              {.unit = kMetres,
               .limits = {0.0, 1e6},
               .meaning = "How far cuts stray along each axis, in the mean of squares.",
               .required = true})
      .metres("over", &sim::CutRoughness::over_m,
              {.unit = kMetres,
               .limits = kLengths,
               .meaning = "Length of the longest waves in which they stray; shorter ones lie on these.",
               .required = true})
      .shared();
}

template <class Named>
std::vector<std::string> calledIn(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

void checkMesh(const Scene& scene, const PiecesSpec& spec, const std::string& path,
               const Check::Complain& complain) {
  if (const std::string none = notCalled("mesh", spec.of, calledIn(scene.meshes)); !none.empty()) {
    complain(path + ".of", none);
    return;
  }
  const auto mesh = std::find_if(scene.meshes.begin(), scene.meshes.end(),
                                 [&](const SceneMesh& one) { return one.name == spec.of; });
  if (!mesh->lines_m.empty())
    complain(path + ".of", fmt::format("the mesh {} is lines, which enclose nothing; expected a closed solid",
                                       inQuotes(spec.of)));
}

void checkImage(const Scene& scene, std::size_t i, const Check::Given& given,
                const Check::Complain& complain) {
  const ImageSpec& image = scene.images[i];
  const bool shown = std::find(image.show.begin(), image.show.end(), "pieces") != image.show.end();
  const std::string path = fmt::format("images[{}]", i);
  if (image.kind != ImageKind::vines) return;
  if (shown && scene.pieces.empty())
    complain(path + ".show",
             "an image of pieces, and the scene has none; expected pieces: {NAME: {of: MESH, by: [PLANT]}}");
  if (!shown && given(path + ".apart"))
    complain(path + ".apart",
             "apart means nothing where no pieces are shown; expected it with show: [pieces]");
}

}  // namespace

std::shared_ptr<const rules::Table> pieceKeys() {
  return TableOf<PiecesSpec>()
      .text("of", &PiecesSpec::of,
            {.meaning = "The name of one of the meshes: a closed solid.", .required = true, .most = 100})
      .names("by", &PiecesSpec::by,
             {.meaning = "The names of the plants whose limbs cut it.", .required = true})
      .metres("kerf", &PiecesSpec::kerf_m,
              {.unit = kMetres,
               .limits = kLengths,
               .meaning = "Width of the gap: what lies within half of it of a limb, or its sheet, is gone.",
               .required = true})
      .place(
          "sweep", &PiecesSpec::sweep_m,
          {.unit = kMetres,
           .limits = kCoordinate,
           .meaning = "Each limb is swept by this into a sheet; without it, the gap is round about limbs."})
      .metres("voxel", &PiecesSpec::voxel_m,
              {.unit = kMetres,
               .limits = {sim::kLeastVoxel_m, sim::kMostVoxel_m},
               .meaning = "Edge of the voxels it is cut in; by default a third of the kerf, and no more than "
                          "the mesh's length in 160."})
      .number("least", &PiecesSpec::least_share,
              {.unit = "share",
               .limits = {0.0, 1.0},
               .meaning = "Pieces of a smaller share of the solid's volume are left out."})
      .section("rough", &PiecesSpec::rough, roughKeys(),
               {.meaning = "Cuts stray by noise, so that what they lay bare is rough."})
      .colour("inside", &PiecesSpec::inside,
              {.meaning = "Of faces that the cut lays bare; without it, that of most of the mesh."})
      .shared();
}

void checkPieces(const Scene& scene, const Check::Given& given, const Check::Complain& complain) {
  const std::vector<std::string> plants = calledIn(scene.plants);
  for (const PiecesSpec& spec : scene.pieces) {
    const std::string path = "pieces." + spec.name;
    checkMesh(scene, spec, path, complain);
    if (spec.by.empty()) complain(path + ".by", "cut by no plants; expected the name of one or more");
    for (std::size_t k = 0; k < spec.by.size(); ++k) {
      if (const std::string none = notCalled("plant", spec.by[k], plants); !none.empty())
        complain(fmt::format("{}.by[{}]", path, k), none);
    }
    if (spec.voxel_m && spec.kerf_m < sim::kLeastKerf_vx * *spec.voxel_m)
      complain(
          path + ".voxel",
          fmt::format("a kerf of {} m is less than {} voxels of {} m, which show it; expected a voxel of "
                      "at most {:.3g} m",
                      spec.kerf_m, sim::kLeastKerf_vx, *spec.voxel_m, spec.kerf_m / sim::kLeastKerf_vx));
  }
  for (std::size_t i = 0; i < scene.images.size(); ++i) checkImage(scene, i, given, complain);
}

}  // namespace espalier::scenes
