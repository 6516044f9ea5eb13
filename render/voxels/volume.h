#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "render/image/camera.h"
#include "render/image/image.h"
#include "sim/base/bits.h"
#include "sim/base/frame.h"
#include "sim/base/vec.h"

/// Volume rendering (Drebin, Carpenter and Hanrahan 1988; Greene 1989, section 5): opacity accumulated along
/// the rays of a camera through voxels that say which share of them is taken. Edges run as smoothly as these
/// shares do, where cubes have steps.
namespace espalier::render {

/// What an occupied voxel is like.
struct VolumeVoxel {
  sim::Colour light{0.0f};  ///< that it sends towards the eye, linear
  float share = 0.0f;       ///< that is taken of its volume, 0..1
};

/// The share that lets as much light through as what is thinner than a voxel, which stops so many of the rays
/// that cross it: 0..1 both. A leaf takes next to nothing of a volume.
float shareOfThin(float stops);

/// A world's voxels, made ready for rays: near all that is seen, the values of a voxel lie beside those of
/// its neighbours. Between the voxels' centres shares run evenly (trilinear), and light in proportion to what
/// stops it, so that no empty voxel darkens its neighbours.
class Volume {
 public:
  /// `full`: the voxels that are taken wholly; what lies deep among these is never looked at. `look` is asked
  /// for the other occupied ones, and for full ones near them, each several times and by several threads.
  /// Throws sim::InputError where it would take more memory than is free for it.
  Volume(const sim::Frame& frame, const sim::BitVolume& occupied, const sim::BitVolume& full,
         const std::function<VolumeVoxel(sim::Voxel)>& look);

  /// Of a pixel: light times opacity, and opacity.
  struct Seen {
    sim::Colour light{0.0f};
    float opacity = 0.0f;
  };
  /// From a place in world space in a direction of unit length. The first voxel width is left out: a plant
  /// may have grown around the eye.
  Seen along(sim::Vec3 from_m, sim::Vec3 direction) const;

  /// What it takes.
  double bytes() const;

 private:
  static constexpr int kSide = 8, kValues = kSide + 1;  // of a brick: its cells, and their corners
  static constexpr std::int32_t kEmpty = -1, kDeep = -2;
  using Value = std::array<float, 4>;  // light times share, and share
  struct Brick {
    std::array<Value, static_cast<std::size_t>(kValues) * kValues * kValues> values{};  // y, z, x
    std::array<std::uint64_t, kSide> taken{};  // cells with a corner that is not empty, z << 3 | x, by y
  };

  std::int32_t brickAt(sim::Voxel brick) const {
    return number_[(static_cast<std::size_t>(brick.y) * static_cast<std::size_t>(count_.z) +
                    static_cast<std::size_t>(brick.z)) *
                       static_cast<std::size_t>(count_.x) +
                   static_cast<std::size_t>(brick.x)];
  }
  static Value valueIn(const Brick& brick, sim::Voxel cell, sim::Vec3f part);

  sim::Frame frame_;
  sim::Voxel count_{0};               // of bricks
  std::vector<std::int32_t> number_;  // of each place's brick
  std::vector<Brick> bricks_;
};

/// What a camera sees: R, G, B times opacity, linear, and opacity. Each pixel is the mean of four rays.
/// Throws sim::InputError where the size is not positive.
Image marchThrough(const Volume& volume, const Camera& camera, int width_px, int height_px);

}  // namespace espalier::render
