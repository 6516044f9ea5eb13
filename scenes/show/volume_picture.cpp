#include "scenes/show/volume_picture.h"

#include <algorithm>
#include <cstdlib>

#include "render/image/tone.h"
#include "render/voxels/volume.h"
#include "scenes/show/voxel_colours.h"
#include "sim/base/parallel.h"

namespace espalier::scenes {
namespace {

/// What voxels send on towards an eye.
class TowardsEye {
 public:
  TowardsEye(const Finished& finished, sim::Vec3 to_sun, sim::Vec3 eye_m)
      : world_(finished.world),
        light_(finished.light),
        bare_(finished.bare),
        eye_vx_(sim::voxelFromWorld(finished.world.frame(), eye_m)),
        colours_(finished.world, finished.bare, finished.light, finished.lit, ImageKind::first_pass, to_sun),
        surfaces_(finished.light.surfaces.size()) {
    sim::parallelFor(surfaces_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto& [voxel, surface] = light_.surfaces[i];
        if (!bare_.at(voxel)) continue;
        const double turned = glm::dot(sim::Vec3(surface.normal), towards(voxel));
        if (turned <= 0.0) continue;
        const sim::Colour light = seenLight(voxel, sim::PartKind::scene);
        surfaces_[i] = {light, colours_.sentOn(light, voxel, sim::PartKind::scene),
                        static_cast<float>(turned)};
      }
    });
  }

  sim::Colour at(sim::Voxel voxel) const {
    const sim::PartKind kind = world_.part(world_.partAt(voxel)).kind;
    if (kind != sim::PartKind::scene) return colours_.sentOn(seenLight(voxel, kind), voxel, kind);
    // Rays get a little way into a solid, past the edges of its faces: they shall not meet there what falls
    // onto the faces behind them, nor the colours of these.
    Turned sum;
    for (int n = 0; n < 27; ++n) {
      const sim::Voxel step = sim::Voxel(n % 3, n / 9, n / 3 % 3) - 1;
      add(voxel + step,
          1.0f / static_cast<float>(1 << (std::abs(step.x) + std::abs(step.y) + std::abs(step.z))), sum);
    }
    if (sum.turned == 0.0f) return colours_.sentOn(seenLight(voxel, kind), voxel, kind);
    if (!light_.where->has(voxel)) return sum.sent / sum.turned;
    return colours_.sentOn(sum.light / sum.turned, voxel, kind);
  }

 private:
  struct Turned {
    sim::Colour light{0.0f}, sent{0.0f};  // what falls on it, and what it sends on
    float turned = 0.0f;                  // how much it is towards the eye: a cosine
  };
  sim::Colour seenLight(sim::Voxel voxel, sim::PartKind kind) const {
    return colours_.lightSeen(towards(voxel), voxel, kind);
  }
  void add(sim::Voxel v, float weight, Turned& sum) const {
    if (!bare_.at(v) || !light_.where->has(v)) return;
    const Turned& surface = surfaces_[light_.where->number(v)];
    sum.light += weight * surface.turned * surface.light;
    sum.sent += weight * surface.turned * surface.sent;
    sum.turned += weight * surface.turned;
  }
  sim::Vec3 towards(sim::Voxel v) const {
    const sim::Vec3 way = eye_vx_ - sim::Vec3(v);
    const double length = glm::length(way);
    return length > 0.0 ? way / length : sim::Vec3(0.0, 1.0, 0.0);
  }

  const sim::World& world_;
  const sim::Lighting& light_;
  const sim::BitVolume& bare_;
  sim::Vec3 eye_vx_;
  VoxelColours colours_;
  std::vector<Turned> surfaces_;  // of the light's
};

}  // namespace

bool drawsVolumes(const std::vector<ImageSpec>& images) {
  return std::any_of(images.begin(), images.end(),
                     [](const ImageSpec& image) { return image.kind == ImageKind::volume; });
}

render::PanelPicture volumePicture(const Finished& finished, sim::Vec3 to_sun, const render::Camera& camera,
                                   int width_px, int height_px) {
  const TowardsEye light(finished, to_sun, camera.eye_m);
  const WorldOccupancy& occupancy = *finished.occupancy;
  const render::Volume volume(
      finished.world.frame(), finished.world.occupied(), occupancy.full(), [&](sim::Voxel v) {
        const sim::Occupancy taken = occupancy.at(v);
        const bool thin = taken.stops > taken.alpha;
        return render::VolumeVoxel{light.at(v), thin ? render::shareOfThin(taken.stops) : taken.alpha};
      });
  render::PanelPicture picture{
      {}, render::marchThrough(volume, camera, width_px, height_px), {"R", "G", "B", "A"}};
  picture.display = render::Image(width_px, height_px, 3);
  const render::CameraRays rays(camera, static_cast<double>(width_px) / height_px);
  const render::ToneCurve tone;
  sim::parallelForEach(static_cast<std::size_t>(height_px), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width_px; ++x) {
      const float* const seen = picture.measured.at(x, y);
      sim::Colour shown = render::skyColour(rays.direction((x + 0.5) / width_px, (y + 0.5) / height_px));
      if (const float opacity = seen[3]; opacity > 0.0f) {
        // As cubes are: what is lit is toned before it is mixed with the sky.
        const sim::Colour lit(tone(seen[0] / opacity), tone(seen[1] / opacity), tone(seen[2] / opacity));
        shown = glm::mix(shown, lit, opacity);
      }
      const sim::Colour display = render::srgbFromLinear(shown);
      std::copy_n(&display.r, 3, picture.display.at(x, y));
    }
  });
  return picture;
}

}  // namespace espalier::scenes
