#include "scenes/made/pieces_made.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/prepare/in_scene.h"
#include "sim/base/counted.h"
#include "sim/base/random.h"

namespace espalier::scenes {
namespace {

/// In which it is cut.
double voxelOf(const PiecesSpec& spec, const sim::Mesh& solid) {
  constexpr double kVoxelsAKerf = 3.0, kVoxelsAlong = 160.0;
  if (spec.voxel_m) return *spec.voxel_m;
  sim::Vec3 low(INFINITY), high(-INFINITY);
  for (const sim::Vec3& p : solid.vertices_m) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const sim::Vec3 across = high - low;
  return std::min(spec.kerf_m / kVoxelsAKerf, std::max({across.x, across.y, across.z}) / kVoxelsAlong);
}

/// The colour of most of a mesh's triangles.
sim::Colour mostlyOf(const sim::Mesh& mesh) {
  std::vector<std::size_t> triangles(mesh.materials.size(), 0);
  for (const std::uint32_t material : mesh.material) ++triangles[material];
  const auto most = std::max_element(triangles.begin(), triangles.end()) - triangles.begin();
  return mesh.materials[static_cast<std::size_t>(most)].colour;
}

sim::CutSettings settingsOf(const Scene& scene, const PiecesSpec& spec, const sim::Mesh& solid) {
  return {spec.kerf_m,
          spec.sweep_m,
          voxelOf(spec, solid),
          spec.least_share,
          spec.inside ? *spec.inside : mostlyOf(solid),
          spec.rough,
          sim::streamOf(scene.seed, "pieces " + spec.name)};
}

/// The limbs of plantings, in the order of their nodes.
std::vector<sim::CutLine> limbsOf(const Scene& scene, const std::vector<std::string>& plantings,
                                  const sim::Growth& growth, const sim::Frame& frame) {
  std::vector<sim::CutLine> limbs;
  for (std::size_t i = 0; i < scene.plants.size(); ++i) {
    if (std::find(plantings.begin(), plantings.end(), scene.plants[i].name) == plantings.end()) continue;
    const sim::Stand& stand = growth.stands[i];
    for (std::size_t p = stand.first; p < stand.first + stand.count; ++p) {
      const sim::Skeleton& tree = growth.plants[p].skeleton;
      for (std::size_t n = 0; n < tree.parent.size(); ++n) {
        if (tree.parent[n] == sim::kNoNode) continue;
        const auto parent = static_cast<std::size_t>(tree.parent[n]);
        limbs.push_back({sim::worldFromVoxel(frame, tree.position_vx[parent]),
                         sim::worldFromVoxel(frame, tree.position_vx[n])});
      }
    }
  }
  return limbs;
}

void nameAfter(const std::string& name, sim::Pieces& cut) {
  for (std::size_t i = 0; i < cut.pieces.size(); ++i) {
    sim::Mesh& mesh = cut.pieces[i].mesh;
    mesh.name = fmt::format("{}_{}", name, i + 1);
    mesh.regions = {mesh.name};
  }
}

/// What came of a cut that nobody wanted; empty where it is well.
std::string failureOf(const PiecesMade& made, std::size_t limbs) {
  if (limbs == 0)
    return fmt::format(
        "the plants that cut it grew no limb, so {} is in one piece; expected plants that grow",
        inQuotes(made.of));
  if (made.cut.pieces.size() > 1) return "";
  return fmt::format(
      "{} cut{} {}, and it stays in one piece: no gap goes all through it; expected a tree that reaches its "
      "rims, "
      "loops, or a longer sweep",
      sim::counted(limbs, "limb"), limbs == 1 ? "s" : "", inQuotes(made.of));
}

}  // namespace

void requirePiecesSound(const Scene& scene, const Site& site) {
  Gathering wrong(scene.file);
  for (const PiecesSpec& spec : scene.pieces) {
    wrong.part(spec.place, [&] {
      const sim::Mesh& solid = meshNamed(site, spec.of);
      sim::requireCuttable(solid, settingsOf(scene, spec, solid));
    });
  }
  wrong.end();
}

std::vector<PiecesMade> makePieces(const Scene& scene, const Site& site, const sim::Growth& growth,
                                   std::vector<Problem>& warnings) {
  std::vector<PiecesMade> all;
  for (const PiecesSpec& spec : scene.pieces) {
    inScene(scene, spec.place, [&] {
      const sim::Mesh& solid = meshNamed(site, spec.of);
      const sim::CutSettings settings = settingsOf(scene, spec, solid);
      const std::vector<sim::CutLine> limbs = limbsOf(scene, spec.by, growth, site.world.frame());
      PiecesMade made{spec.name, spec.of, spec.kerf_m, settings.voxel_m,
                      sim::cutSolid(solid, limbs, settings)};
      nameAfter(spec.name, made.cut);
      if (std::string failure = failureOf(made, limbs.size()); !failure.empty())
        warnings.push_back(problemAt(spec.place, scene.file, std::move(failure)));
      all.push_back(std::move(made));
    });
  }
  return all;
}

}  // namespace espalier::scenes
