#include "scenes/show/volume_picture.h"

#include <algorithm>

#include "render/image/tone.h"
#include "render/voxels/volume.h"
#include "scenes/show/voxel_colours.h"
#include "sim/base/parallel.h"

namespace espalier::scenes {

bool drawsVolumes(const std::vector<ImageSpec>& images) {
  return std::any_of(images.begin(), images.end(),
                     [](const ImageSpec& image) { return image.kind == ImageKind::volume; });
}

struct VolumePictures::Lit {
  Lit(const Finished& finished, sim::Vec3 to_sun)
      : colours(finished.world, finished.bare, finished.light, finished.lit, ImageKind::first_pass, to_sun),
        volume(finished.world.frame(), finished.world.occupied(), finished.occupancy->full(),
               [&](sim::Voxel v) {
                 const sim::PartKind kind = finished.world.part(finished.world.partAt(v)).kind;
                 return render::VolumeVoxel{colours.lightAt(v, kind), finished.occupancy->at(v).stops};
               }) {}
  VoxelColours colours;
  render::Volume volume;
};

VolumePictures::VolumePictures(const Finished& finished, sim::Vec3 to_sun)
    : finished_(finished), to_sun_(to_sun) {}
VolumePictures::~VolumePictures() = default;

render::PanelPicture VolumePictures::draw(const render::Camera& camera, int width_px, int height_px) {
  if (!lit_) lit_ = std::make_unique<const Lit>(finished_, to_sun_);
  render::PanelPicture picture{
      {}, render::marchThrough(lit_->volume, camera, width_px, height_px), {"R", "G", "B", "A"}};
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
