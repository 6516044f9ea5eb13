#include "render/voxels/shadow.h"

#include "sim/base/parallel.h"

#include <cmath>

namespace espalier::render {
namespace {

using sim::faceAxis;
using sim::kFaceNormals;

/// Rays start this far in front of the face, voxel widths: clear of rounding, too near to skip anything.
constexpr double kLift = 1e-4;
/// A pixel at a shadow's edge is judged at these places of it, in pixels, along each side.
constexpr std::array<double, 3> kWithinPixel = {1 / 6.0, 3 / 6.0, 5 / 6.0};

class Sun {
 public:
  Sun(const sim::BitVolume& occupied, const sim::Bricks& bricks, sim::Vec3 to_sun)
      : occupied_(occupied), bricks_(bricks), to_sun_(to_sun) {}

  bool faces(const Fragment& f) const {
    return f.face != kSky && glm::dot(sim::Vec3(kFaceNormals[f.face]), to_sun_) > 0.0;
  }
  bool reaches(const Fragment& f, glm::dvec2 at) const {
    const int axis = faceAxis(f.face);
    sim::Vec3 place(f.voxel);
    place[axis] += (0.5 + kLift) * kFaceNormals[f.face][axis];
    place[(axis + 1) % 3] += at.x;
    place[(axis + 2) % 3] += at.y;
    return !sim::firstHit(occupied_, bricks_, place, to_sun_);
  }

 private:
  const sim::BitVolume& occupied_;
  const sim::Bricks& bricks_;
  sim::Vec3 to_sun_;
};

/// Where on a fragment's face the camera's ray meets the face's plane, from the voxel's centre.
glm::dvec2 placeOnFace(const Visibility& seen, sim::Vec3 eye_vx, const Fragment& f, double x, double y) {
  const sim::Vec3 direction = seen.rays.direction(x / seen.width, y / seen.height);
  const int axis = faceAxis(f.face);
  const double plane = f.voxel[axis] + 0.5 * kFaceNormals[f.face][axis];
  const sim::Vec3 place =
      eye_vx + direction * ((plane - eye_vx[axis]) / direction[axis]) - sim::Vec3(f.voxel);
  return {place[(axis + 1) % 3], place[(axis + 2) % 3]};
}

}  // namespace

std::vector<float> castShadows(const Visibility& seen, const sim::BitVolume& occupied,
                               const sim::Bricks& bricks, sim::Vec3 to_sun) {
  const Sun sun(occupied, bricks, to_sun);
  std::vector<float> lit(seen.fragments.size(), 0.0f);
  sim::parallelFor(lit.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Fragment& f = seen.fragments[i];
      if (sun.faces(f) && sun.reaches(f, f.at)) lit[i] = 1.0f;
    }
  });

  // Where the light changes between a fragment and its pixel's neighbours, it is asked for in nine places.
  std::vector<float> smooth = lit;
  const sim::Vec3 eye_vx = sim::voxelFromWorld(seen.frame, seen.rays.eye_m());
  const std::size_t width = static_cast<std::size_t>(seen.width);
  sim::parallelForEach(static_cast<std::size_t>(seen.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < seen.width; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      const auto differs = [&](std::size_t other, const Fragment& f, float light) {
        for (std::size_t j = seen.starts[other]; j < seen.starts[other + 1]; ++j)
          if (seen.fragments[j].face == f.face && lit[j] != light) return true;
        return false;
      };
      for (std::size_t i = seen.starts[pixel]; i < seen.starts[pixel + 1]; ++i) {
        const Fragment& f = seen.fragments[i];
        if (!sun.faces(f)) continue;
        const bool edge = differs(pixel, f, lit[i]) || (x > 0 && differs(pixel - 1, f, lit[i])) ||
                          (x + 1 < seen.width && differs(pixel + 1, f, lit[i])) ||
                          (y > 0 && differs(pixel - width, f, lit[i])) ||
                          (y + 1 < seen.height && differs(pixel + width, f, lit[i]));
        if (!edge) continue;
        int tried = 0, reached = 0;
        for (const double dy : kWithinPixel) {
          for (const double dx : kWithinPixel) {
            const glm::dvec2 at = placeOnFace(seen, eye_vx, f, x + dx, y + dy);
            if (!(std::abs(at.x) <= 0.5 && std::abs(at.y) <= 0.5)) continue;
            ++tried;
            reached += sun.reaches(f, at);
          }
        }
        if (tried > 0) smooth[i] = static_cast<float>(reached) / static_cast<float>(tried);
      }
    }
  });
  return smooth;
}

}  // namespace espalier::render
