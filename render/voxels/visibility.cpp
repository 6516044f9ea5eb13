#include "render/voxels/visibility.h"

#include <fmt/format.h>
#include "sim/base/parallel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

#include "render/voxels/free_way.h"
#include "sim/base/error.h"

// Every pixel is found by itself and rows are joined in order, so the answer does not depend on the threads.
namespace espalier::render {
namespace {

using sim::faceAxis;
using sim::kFaceNormals;

/// Eight rooks: no two samples share a row or a column of the pixel, so near-vertical and near-horizontal
/// edges come out in nine shades.
constexpr int kSubsamples = 8;
constexpr std::array<glm::dvec2, kSubsamples> kOffsets = {{{1 / 16.0, 7 / 16.0},
                                                           {3 / 16.0, 13 / 16.0},
                                                           {5 / 16.0, 3 / 16.0},
                                                           {7 / 16.0, 9 / 16.0},
                                                           {9 / 16.0, 15 / 16.0},
                                                           {11 / 16.0, 5 / 16.0},
                                                           {13 / 16.0, 11 / 16.0},
                                                           {15 / 16.0, 1 / 16.0}}};

/// Beyond this many voxel widths a point is not worth finding by a shortcut.
constexpr double kFar = 1e6;

std::uint8_t faceOf(sim::Voxel normal) {
  for (std::uint8_t face = 0; face < kSky; ++face)
    if (kFaceNormals[face] == normal) return face;
  return kSky;
}

bool alike(const Fragment& a, const Fragment& b) {
  return a.face == b.face && a.voxel == b.voxel;
}

bool coplanar(const Fragment& a, const Fragment& b) {
  return a.face == b.face && a.face != kSky && a.voxel[faceAxis(a.face)] == b.voxel[faceAxis(a.face)];
}

class Eye {
 public:
  Eye(const sim::Frame& frame, const sim::BitVolume& occupied, const sim::Bricks& bricks,
      const CameraRays& rays, int width, int height)
      : occupied_(occupied),
        bricks_(bricks),
        rays_(rays),
        eye_vx_(sim::voxelFromWorld(frame, rays.eye_m())),
        width_(width),
        height_(height) {}

  /// What is seen at a point of the image, in pixels, and how far away.
  struct Look {
    Fragment fragment;
    double distance_vx = std::numeric_limits<double>::infinity();
  };
  Look look(double x, double y, double free_vx) const {
    const sim::Vec3 direction = rays_.direction(x / width_, y / height_);
    const std::optional<sim::RayHit> hit = sim::firstHit(occupied_, bricks_, eye_vx_, direction, free_vx);
    if (!hit) return {};
    return {onFace(eye_vx_ + hit->t * direction, hit->voxel, faceOf(hit->face)), hit->t};
  }

  /// The same where the pixels around see nothing but the plane of a face: no ray needs to be walked.
  Fragment lookAtPlane(double x, double y, const Fragment& face, double free_vx) const {
    const sim::Vec3 direction = rays_.direction(x / width_, y / height_);
    const int axis = faceAxis(face.face);
    const double plane = face.voxel[axis] + 0.5 * kFaceNormals[face.face][axis];
    const double t = (plane - eye_vx_[axis]) / direction[axis];
    if (!(t > 0.0 && t < kFar)) return look(x, y, free_vx).fragment;
    const sim::Vec3 place = eye_vx_ + direction * t;
    sim::Voxel voxel = sim::voxelAt(place);
    voxel[axis] = face.voxel[axis];
    if (!occupied_.at(voxel) || occupied_.at(voxel + kFaceNormals[face.face]))
      return look(x, y, free_vx).fragment;
    return onFace(place, voxel, face.face);
  }

 private:
  static Fragment onFace(sim::Vec3 place, sim::Voxel voxel, std::uint8_t face) {
    const sim::Vec3 from_centre = place - sim::Vec3(voxel);
    const int axis = faceAxis(face);
    return {voxel, glm::vec2(from_centre[(axis + 1) % 3], from_centre[(axis + 2) % 3]), face, 1};
  }

  const sim::BitVolume& occupied_;
  const sim::Bricks& bricks_;
  const CameraRays& rays_;
  sim::Vec3 eye_vx_;
  double width_, height_;
};

void appendSubsamples(const Eye& eye, const FreeWay& free, int x, int y, const Fragment* plane,
                      std::vector<Fragment>& row) {
  const std::size_t first = row.size();
  const double free_vx = free.of({x + 0.5, y + 0.5}, 1);
  for (const glm::dvec2 offset : kOffsets) {
    const double px = x + offset.x, py = y + offset.y;
    const Fragment seen =
        plane ? eye.lookAtPlane(px, py, *plane, free_vx) : eye.look(px, py, free_vx).fragment;
    std::size_t i = first;
    while (i < row.size() && !alike(row[i], seen)) ++i;
    if (i == row.size()) {
      row.push_back(seen);
    } else {
      row[i].at += seen.at;
      ++row[i].samples;
    }
  }
  for (std::size_t i = first; i < row.size(); ++i) row[i].at /= static_cast<float>(row[i].samples);
}

/// What each pixel's middle sees, rows from the top: a coarse grid first, then what lies between.
std::vector<Fragment> middles(const Eye& eye, FreeWay& free, int width, int height) {
  constexpr int kCoarsest = 8;
  std::vector<Fragment> seen(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int apart = kCoarsest; apart >= 1; apart /= 2) {
    sim::parallelForEach(static_cast<std::size_t>((height + apart - 1) / apart), [&](std::size_t line) {
      const int y = static_cast<int>(line) * apart;
      for (int x = 0; x < width; x += apart) {
        const bool known = apart < kCoarsest && (x | y) % (2 * apart) == 0;
        if (known) continue;
        const double px = x + 0.5, py = y + 0.5;
        const double free_vx = apart < kCoarsest ? free.of({px, py}, 2 * apart) : 0.0;
        const Eye::Look look = eye.look(px, py, free_vx);
        seen[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
            look.fragment;
        free.tell({x, y}, look.distance_vx);
      }
    });
  }
  return seen;
}

}  // namespace

Visibility see(const sim::Frame& frame, const sim::BitVolume& occupied, const sim::Bricks& bricks,
               const Camera& camera, int width_px, int height_px, std::size_t most) {
  if (width_px < 1 || height_px < 1)
    throw sim::InputError(
        fmt::format("a picture of {} x {} pixels; both must be at least 1", width_px, height_px));
  Visibility all{width_px, height_px, frame, CameraRays(camera, static_cast<double>(width_px) / height_px),
                 {},       {}};
  if (occupied.at(sim::voxelAt(sim::voxelFromWorld(frame, camera.eye_m)))) {
    throw sim::InputError(
        fmt::format("the camera at [{:g}, {:g}, {:g}] stands inside an occupied voxel; move it out",
                    camera.eye_m.x, camera.eye_m.y, camera.eye_m.z));
  }
  const Eye eye(frame, occupied, bricks, all.rays, width_px, height_px);

  const std::size_t width = static_cast<std::size_t>(width_px), height = static_cast<std::size_t>(height_px);
  FreeWay free(camera, width_px, height_px, sim::voxelFromWorld(frame, camera.eye_m), occupied);
  const std::vector<Fragment> centres = middles(eye, free, width_px, height_px);

  std::vector<std::vector<Fragment>> rows(height);
  all.starts.assign(width * height + 1, 0);
  std::atomic<std::size_t> seen = 0;  // more than `most`, or not: whatever the order of the rows
  sim::parallelForEach(static_cast<std::size_t>(height_px), [&](std::size_t line) {
    const int y = static_cast<int>(line);
    std::vector<Fragment>& row = rows[static_cast<std::size_t>(y)];
    if (seen > most) return;
    row.reserve(2 * width);
    for (int x = 0; x < width_px; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      const Fragment& centre = centres[i];
      const std::array<const Fragment*, 4> around = {
          &centres[x > 0 ? i - 1 : i], &centres[x + 1 < width_px ? i + 1 : i],
          &centres[y > 0 ? i - width : i], &centres[y + 1 < height_px ? i + width : i]};
      const auto seesAlike = [&](const Fragment* other) { return alike(centre, *other); };
      const auto seesPlane = [&](const Fragment* other) { return coplanar(centre, *other); };
      const std::size_t before = row.size();
      if (std::all_of(around.begin(), around.end(), seesAlike))
        row.push_back(centre);
      else
        appendSubsamples(eye, free, x, y,
                         std::all_of(around.begin(), around.end(), seesPlane) ? &centre : nullptr, row);
      all.starts[i + 1] = row.size() - before;
    }
    seen += row.size();
  });
  if (seen > most) {
    throw sim::InputError(fmt::format(
        "a picture of {} x {} pixels sees more faces of voxels than the memory that is free for it here "
        "can hold; expected fewer pixels, or a camera that is nearer",
        width_px, height_px));
  }
  for (std::size_t i = 0; i < width * height; ++i) all.starts[i + 1] += all.starts[i];
  all.fragments.reserve(all.starts.back());
  for (const std::vector<Fragment>& row : rows)
    all.fragments.insert(all.fragments.end(), row.begin(), row.end());
  return all;
}

}  // namespace espalier::render
