#include "scenes/show/cut_out_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "render/image/cut_out.h"
#include "render/model/radii.h"
#include "scenes/problem.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;

constexpr double kOnIt_vx = 1.5;  // limbs that are farther from the plane are not on it

/// Where a mesh lies, and how it is looked at.
struct View {
  Vec3 middle_m{0.0}, right{1, 0, 0}, up{0, 1, 0}, toward{0, 0, 1};

  glm::vec2 operator()(Vec3 at_m) const {
    return {glm::dot(at_m - middle_m, right), glm::dot(at_m - middle_m, up)};
  }
};

const sim::Mesh& meshOf(const std::vector<sim::TiledMesh>& meshes, const ImageSpec& image) {
  for (const sim::TiledMesh& tiled : meshes) {
    if (tiled.lines.empty() && (image.mesh.empty() || tiled.mesh.name == image.mesh)) return tiled.mesh;
  }
  throw sim::InputError(fmt::format("image '{}': there is no mesh '{}' with faces", image.name, image.mesh));
}

View viewOf(const sim::Mesh& mesh, const ImageSpec& image) {
  Vec3 sum(0.0), middle(0.0);
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 at = mesh.vertices_m[a];
    const Vec3 cross = glm::cross(mesh.vertices_m[b] - at, mesh.vertices_m[c] - at);
    const double own = glm::length(cross);
    sum += cross;
    middle += own / 3.0 * (at + mesh.vertices_m[b] + mesh.vertices_m[c]);
    area += own;
  }
  // Of a closed body no side is the one.
  if (!(glm::length(sum) > 1e-3 * area)) {
    throw sim::InputError(fmt::format(
        "image '{}': the mesh '{}' has no side from which it is seen straight on; expected an open sheet",
        image.name, mesh.name));
  }
  View view;
  view.middle_m = middle / area;
  view.toward = glm::normalize(sum);
  const bool level = std::abs(view.toward.y) > 0.99;
  const Vec3 upright = level ? Vec3(0, 0, -1) : Vec3(0, 1, 0);
  view.right = glm::normalize(glm::cross(upright, view.toward));
  view.up = glm::cross(view.toward, view.right);
  return view;
}

void addLimbs(const sim::Plant& plant, const sim::Frame& frame, const View& view,
              std::vector<render::CutOutLine>& lines) {
  const sim::Skeleton& s = plant.skeleton;
  const std::vector<float> radii_vx = render::stemRadii(s, plant.girth);
  const auto on = [&](Vec3 at_m) {
    return std::abs(glm::dot(at_m - view.middle_m, view.toward)) <= kOnIt_vx * frame.voxel_m;
  };
  for (std::size_t n = 0; n < s.parent.size(); ++n) {
    if (s.parent[n] == sim::kNoNode) continue;
    const auto parent = static_cast<std::size_t>(s.parent[n]);
    const Vec3 from_m = sim::worldFromVoxel(frame, s.position_vx[parent]),
               to_m = sim::worldFromVoxel(frame, s.position_vx[n]);
    if (!on(from_m) || !on(to_m)) continue;
    const auto radius = static_cast<float>(static_cast<double>(radii_vx[n]) * frame.voxel_m);
    lines.push_back({view(from_m), view(to_m), radius, radius, plant.stem_colour});
  }
}

}  // namespace

void requireCutOutsSeen(const Scene& scene, const std::vector<sim::TiledMesh>& meshes) {
  Gathering wrong(scene.file);
  for (const ImageSpec& image : scene.images) {
    if (image.kind == ImageKind::cut_out)
      wrong.part(scene.images_place, [&] { viewOf(meshOf(meshes, image), image); });
  }
  wrong.end();
}

render::Image drawCutOut(const Finished& finished, const ImageSpec& image, glm::ivec2 most_px) {
  const sim::Mesh& mesh = meshOf(finished.meshes, image);
  const View view = viewOf(mesh, image);
  std::vector<render::CutOutTriangle> body;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    render::CutOutTriangle& triangle = body.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) triangle.corners[i] = view(mesh.vertices_m[mesh.triangles[t][i]]);
    triangle.colour = mesh.materials.at(mesh.material.at(t)).colour;
  }
  std::vector<render::CutOutLine> lines;
  for (const sim::Plant& plant : finished.growth.plants) addLimbs(plant, finished.world.frame(), view, lines);
  // The thinnest first, so that what is thick goes on over what joins it.
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return a.from_radius < b.from_radius; });
  try {
    return render::drawCutOut(body, lines, most_px.x, most_px.y);
  } catch (const sim::InputError& error) {
    throw sim::InputError(fmt::format("image '{}': {}", image.name, error.what()));
  }
}

}  // namespace espalier::scenes
