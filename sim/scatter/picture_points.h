#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/base/vec.h"
#include "sim/scatter/point_set.h"

/// Points as dense as a picture is bright.
namespace espalier::sim {

/// A picture as densities from 0 to 1; rows from the top.
struct DensityPicture {
  std::int32_t width = 0, height = 0;
  std::vector<float> density;
};

/// Where a picture is laid: a parallelogram in the units of the points.
struct PictureFrame {
  Vec3 top_left{0.0};
  Vec3 across{0.0};  ///< from there to its top right corner
  Vec3 down{0.0};    ///< and to its bottom left one
};

/// Throws InputError for a frame without an area or that is no number, a picture of another size than it
/// says, densities beyond 0 to 1, and one that is 0 everywhere.
void requireSound(const DensityPicture& picture, const PictureFrame& frame);

/// Points over a picture: each falls into a pixel with the pixel's share of all density, anywhere in it
/// alike, and has the normal of the side from which the picture is seen. Each follows from the stream and its
/// number alone, so that more of them begin with the same ones. Throws InputError as requireSound, for no
/// points, and for more than 2^32 - 1.
PointSet scatterOver(const DensityPicture& picture, const PictureFrame& frame, std::size_t count,
                     std::uint64_t stream);

/// Poisson-disc points whose density follows the picture: of those that scatterOver has, in their order, each
/// that keeps from all before it the lesser of the two spacings there, which is `spacing` where the density
/// is 1 and goes with the inverse of its square root. At most `count`, fewer where it is full; in several
/// waves as scatterApart has them. Throws as scatterOver, and for a spacing that is not above 0.
PointSet scatterOverApart(const DensityPicture& picture, const PictureFrame& frame, std::size_t count,
                          double spacing, std::uint64_t stream, int waves = 1);

}  // namespace espalier::sim
