#include "render/voxels/free_way.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace espalier::render {
namespace {

constexpr int kNear = 12;  // voxels around the eye that must be free: what is so near may look like a spike
constexpr int kMostAround = 6;                                  // beyond, a ray costs less than to ask
const double kBall = 0.5, kCorner = 0.5 * std::numbers::sqrt3;  // from a voxel's centre
/// A disc that holds a pixel's middle wherever it lies, pixels.
const double kDisc = 0.5 * std::numbers::sqrt2;
/// Between two places on one voxel, with room for rounding.
const double kDiagonal = std::numbers::sqrt3 + 0.02;

bool anyNear(const sim::BitVolume& occupied, sim::Voxel centre) {
  for (int y = -kNear; y <= kNear; ++y)
    for (int z = -kNear; z <= kNear; ++z)
      for (int x = -kNear; x <= kNear; ++x)
        if (occupied.at(centre + sim::Voxel(x, y, z))) return true;
  return false;
}

}  // namespace

FreeWay::FreeWay(const Camera& camera, int width_px, int height_px, sim::Vec3 eye_vx,
                 const sim::BitVolume& occupied)
    : size_(width_px, height_px),
      met_vx_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
  if (anyNear(occupied, sim::voxelAt(eye_vx))) return;
  const double tall = std::tan(camera.fov_deg * std::numbers::pi / 360.0);
  const double widest = std::hypot(tall, tall * width_px / height_px);  // in the picture's corners
  // With pictures of tangents: a voxel's disc has the radius 0.5 / z at a depth z. Its corner is at most 0.87
  // / (z - 0.87) from its middle, over the cosine of the angle between the middle and the camera's axis.
  double cosine = 1.0 / std::sqrt(1.0 + widest * widest), depth_vx = 0.0, corner = 0.0;
  for (int i = 0; i < 8; ++i) {  // that middle may lie outside of the picture, by as much as the corner's way
    depth_vx = kNear * cosine;
    if (!(depth_vx > 2.0 * kCorner)) return;
    corner = kCorner / ((depth_vx - kCorner) * cosine);
    cosine = 1.0 / std::sqrt(1.0 + (widest + corner) * (widest + corner));
  }
  // From the corner to the disc the part is at least a cone, with a disc of kDisc within kDisc * ratio.
  const double ratio = corner * depth_vx / kBall;
  const int around = static_cast<int>(std::floor(kDisc * (ratio + 1.0) + 0.5));
  if (around > kMostAround) return;
  around_ = around;
  disc_one_px_vx_ = 0.5 * height_px / tall * kBall / kDisc * 0.99;
}

double FreeWay::of(glm::dvec2 at_px, int apart) const {
  if (around_ == 0) return 0.0;
  const auto nearest = [apart](double px) { return static_cast<int>(std::lround((px - 0.5) / apart)); };
  const glm::ivec2 middle(nearest(at_px.x), nearest(at_px.y));
  const glm::ivec2 low = (middle - around_) * apart, high = (middle + around_) * apart;
  // Beyond the picture's edge nobody looked.
  if (low.x < 0 || low.y < 0 || high.x >= size_.x || high.y >= size_.y) return 0.0;
  float met = std::numeric_limits<float>::infinity();
  for (int y = low.y; y <= high.y; y += apart)
    for (int x = low.x; x <= high.x; x += apart) met = std::min(met, met_vx_[index({x, y})]);
  // note: a float may be rounded up by a part in 2^24.
  return std::max(0.0, std::min(met * (1.0 - 0x1p-20) - kDiagonal, disc_one_px_vx_ / apart));
}

}  // namespace espalier::render
