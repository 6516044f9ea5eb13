#include "tests/bench/voxel_faces.h"

namespace espalier::bench {
namespace {

/// The faces of one plane of voxels that look to one side.
class Plane {
 public:
  Plane(int width, int height)
      : width_(width),
        height_(height),
        faces_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  char& at(int u, int v) {
    return faces_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(u)];
  }
  /// Takes out the rectangle that begins at a face: its faces across and along.
  std::array<int, 2> take(int u, int v, bool joined) {
    int across = 1, along = 1;
    const auto full = [&](int row) {
      for (int i = 0; i < across; ++i) {
        if (!at(u + i, row)) return false;
      }
      return true;
    };
    while (joined && u + across < width_ && at(u + across, v)) ++across;
    while (joined && v + along < height_ && full(v + along)) ++along;
    for (int j = 0; j < along; ++j) {
      for (int i = 0; i < across; ++i) at(u + i, v + j) = 0;
    }
    return {across, along};
  }

 private:
  int width_, height_;
  std::vector<char> faces_;
};

/// The axes of a plane at right angles to `normal`, and where it lies.
struct Place {
  int normal, depth;
  int across() const { return (normal + 1) % 3; }
  int along() const { return (normal + 2) % 3; }
  sim::Voxel voxel(int u, int v) const {
    sim::Voxel voxel(0);
    voxel[normal] = depth;
    voxel[across()] = u;
    voxel[along()] = v;
    return voxel;
  }
};

void addQuad(VoxelFaces& faces, const Place& place, int side, int u, int v, std::array<int, 2> extent) {
  sim::Vec3f low = sim::Vec3f(place.voxel(u, v)) - 0.5f;
  low[place.normal] = static_cast<float>(place.depth) + 0.5f * static_cast<float>(side);
  sim::Vec3f right(0.0f), up(0.0f);
  right[place.across()] = static_cast<float>(extent[0]);
  up[place.along()] = static_cast<float>(extent[1]);
  const auto first = static_cast<std::uint32_t>(faces.corners.size());
  for (const sim::Vec3f& corner : {low, low + right, low + right + up, low + up})
    faces.corners.push_back(corner);
  faces.quads.push_back({first, first + 1, first + 2, first + 3});
}

}  // namespace

VoxelFaces voxelFaces(const sim::BitVolume& occupied, bool joined) {
  VoxelFaces faces;
  const sim::Voxel size = occupied.size();
  for (Place place{0, 0}; place.normal < 3; ++place.normal) {
    const int width = size[place.across()], height = size[place.along()];
    for (const int side : {-1, 1}) {
      sim::Voxel step(0);
      step[place.normal] = side;
      for (place.depth = 0; place.depth < size[place.normal]; ++place.depth) {
        Plane plane(width, height);
        for (int v = 0; v < height; ++v) {
          for (int u = 0; u < width; ++u) {
            const sim::Voxel here = place.voxel(u, v);
            plane.at(u, v) = occupied.at(here) && !occupied.at(here + step);
          }
        }
        for (int v = 0; v < height; ++v) {
          for (int u = 0; u < width; ++u) {
            if (plane.at(u, v)) addQuad(faces, place, side, u, v, plane.take(u, v, joined));
          }
        }
      }
    }
  }
  return faces;
}

}  // namespace espalier::bench
