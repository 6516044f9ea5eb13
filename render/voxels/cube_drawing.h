#pragma once
#include <array>
#include <vector>

#include "render/image/camera.h"
#include "render/image/image.h"
#include "sim/base/frame.h"
#include "sim/base/vec.h"

/// A small world as a textbook shows it (Greene 1989, figure 1): the lattice of its voxels, those that are
/// occupied as cubes that one can look into, and in them the polygons and lines that occupy them.
namespace espalier::render {

/// An occupied voxel. Colours here are linear.
struct Cube {
  sim::Voxel voxel{0};
  sim::Colour colour{0.5f};
};

struct CubeTriangle {
  std::array<sim::Vec3, 3> corners_m{};
  /// Of the side from each corner to the next: whether it is drawn, as the border of a polygon is, and not
  /// the cuts between the triangles that it is made of.
  std::array<bool, 3> border{true, true, true};
  sim::Colour colour{0.3f};
};

/// A point where both ends are one.
struct CubeLine {
  sim::Vec3 from_m{0.0}, to_m{0.0};
  sim::Colour colour{0.3f};
};

struct CubeWorld {
  sim::Frame frame;
  std::vector<Cube> cubes;
  std::vector<CubeTriangle> triangles;  ///< shown as far as they lie in cubes
  std::vector<CubeLine> lines;          ///< likewise
};

/// Draws it on paper, from far to near. The walls of the world that the camera sees from inside carry the
/// lattice. What lies behind the eye is left out. Display values. The drawing takes time in proportion to
/// the voxels of the whole world: it is meant for some dozens a side.
Image drawCubes(const CubeWorld& world, const Camera& camera, int width_px, int height_px);

}  // namespace espalier::render
