#include "scenes/show/flat_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "render/voxels/attempts.h"
#include "render/voxels/narrow_band.h"
#include "render/voxels/section.h"
#include "sim/base/error.h"
#include "sim/base/memory.h"

namespace espalier::scenes {
namespace {

/// A cut's picture axes in the world: along which the picture runs across and up.
std::pair<int, int> picturePlane(int axis) {
  switch (axis) {
    case 0:
      return {2, 1};
    case 1:
      return {0, 2};
    default:
      return {0, 1};
  }
}

/// A world that is long and narrow makes a picture that is.
void requireFits(const ImageSpec& image, double width_px, glm::ivec2 size) {
  const double bytes = 3.0 * sizeof(float) * width_px * (width_px * size.y / size.x);
  if (bytes <= 0.1 * sim::memoryBudget()) return;
  throw sim::InputError(
      fmt::format("image '{}': a picture of {} x {} voxels takes {} of memory; expected a cut "
                  "that is less narrow",
                  image.name, size.x, size.y, sim::inGigabytes(bytes)));
}

/// Throws where it misses the world.
render::CutPlane planeOf(const sim::Frame& frame, const ImageSpec& image) {
  render::CutPlane plane;
  plane.axis = image.axis - 'x';
  std::tie(plane.across, plane.up) = picturePlane(plane.axis);
  sim::Vec3 point_m = frame.origin_m;
  point_m[plane.axis] = image.at_m;
  plane.at = sim::voxelAt(sim::voxelFromWorld(frame, point_m))[plane.axis];
  if (plane.at < 0 || plane.at >= frame.size[plane.axis]) {
    throw sim::InputError(
        fmt::format("image '{}': a cut at {} = {} m misses the world", image.name, image.axis, image.at_m));
  }
  return plane;
}

}  // namespace

render::Image drawSection(const sim::World& world, const ImageSpec& image) {
  const sim::Frame& frame = world.frame();
  const auto [axis, across, up, at] = planeOf(frame, image);
  render::SectionLook look;
  look.size = {frame.size[across], frame.size[up]};
  look.layers = world.layers();
  requireFits(image, look.width_px, look.size);
  if (!image.caption.empty()) look.title = image.caption;
  return render::drawSection(
      [&, axis = axis, across = across, up = up, at = at](glm::ivec2 p) {
        sim::Voxel v(0);
        v[axis] = at;
        v[across] = p.x;
        v[up] = p.y;
        render::Cut cut;
        if (const auto surface = world.surfaceAt(v)) {
          cut.occupied = true;
          cut.colour = surface->colour;
        } else if (const auto nearness = world.nearnessAt(v)) {
          cut.layer = nearness->layer;
        }
        return cut;
      },
      look);
}

render::Image drawNarrowBand(const std::vector<sim::TiledMesh>& meshes, const sim::Frame& frame,
                             const ImageSpec& image) {
  const auto found = std::find_if(meshes.begin(), meshes.end(), [&](const sim::TiledMesh& tiled) {
    return image.mesh.empty() || tiled.mesh.name == image.mesh;
  });
  if (found == meshes.end())
    throw sim::InputError(fmt::format("image '{}': there is no mesh '{}'", image.name, image.mesh));
  const sim::Mesh& mesh = found->mesh;
  const render::CutPlane plane = planeOf(frame, image);
  render::BandLook look;
  requireFits(image, look.width_px, {frame.size[plane.across], frame.size[plane.up]});
  const double bytes = render::bandBytes(mesh, frame, plane);
  if (bytes > 0.3 * sim::memoryBudget()) {
    throw sim::InputError(
        fmt::format("image '{}': the level set of '{}' in voxels of {:.3g} m takes {} of memory; expected "
                    "larger voxels",
                    image.name, mesh.name, frame.voxel_m, sim::inGigabytes(bytes)));
  }
  const render::BandCut cut = render::bandCut(mesh, frame, plane);
  look.title = image.caption.empty() ? "narrow band of " + mesh.name : image.caption;
  look.note = fmt::format("signed distance, {} voxels to either side; a voxel is {:.3g} m", render::kBand,
                          frame.voxel_m);
  if (!cut.has_inside) look.note += "\nnothing of this cut lies inside";
  return render::drawNarrowBand(cut, look);
}

render::Image drawAttempts(const sim::World& world, const std::vector<sim::Attempt>& attempts,
                           const ImageSpec& image) {
  const sim::Voxel size = world.frame().size;
  const int axis = size.x == 1 ? 0 : size.y == 1 ? 1 : 2;
  const auto [across, up] = picturePlane(axis);
  std::vector<render::Attempt> drawn;
  for (const sim::Attempt& a : attempts) {
    drawn.push_back({{a.from_vx[across], a.from_vx[up]}, {a.to_vx[across], a.to_vx[up]}, a.taken});
  }
  std::vector<glm::ivec2> occupied;
  for (const sim::TiledVoxel& tiled : world.surfaces()) {
    occupied.emplace_back(tiled.voxel[across], tiled.voxel[up]);
  }
  render::AttemptsLook look;
  look.size = {size[across], size[up]};
  requireFits(image, 2.0 * look.frame_width_px, look.size);
  return render::drawAttempts(drawn, occupied, look);
}

}  // namespace espalier::scenes
