#include "sim/tile/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/memory.h"
#include "sim/tile/build_world.h"

namespace espalier::sim {
namespace {

constexpr double kLongestAxis = 16000;  // what tiling's fixed point can hold, less a rim

/// Bit volumes: what is occupied, by plants too, what is solid, what takes light, and four more while what is
/// closed is found or places are looked at. Then one marks the places for a sweep, and the light's rays and
/// those of the table of the sky go by one each at most: half a volume of horizons, and for each of the four
/// octants above a byte a brick, which is half a volume where the world is one voxel thick, and a sixteenth
/// where it is thick. Surfaces as large as the world's own sides: their grids, taps and places with the
/// directions that are open there; 35 bytes for each layer before them. Fields of every voxel.
double worldBytes(Vec3 size, const WorldUse& use) {
  const double voxels = size.x * size.y * size.z;
  const double padded = (size.x + 2 * 64) / size.x;
  const double sides = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
  return (8.0 / 8 * padded + use.bytes_per_voxel) * voxels + (250.0 + 35.0 * use.layers) * sides;
}

bool fits(Vec3 size, const WorldUse& use) {
  return std::max({size.x, size.y, size.z}) <= kLongestAxis && worldBytes(size, use) <= memoryBudget();
}

/// Rounded up to two digits.
double rounded(double voxel_m) {
  const double digit = std::pow(10.0, std::floor(std::log10(voxel_m)) - 1);
  return std::ceil(voxel_m / digit - 1e-9) * digit;
}

double fittingVoxel(Vec3 size, double voxel_m, const WorldUse& use) {
  const auto fitsAt = [&](double v) { return fits(glm::ceil(size * (voxel_m / v)), use); };
  double low = voxel_m;
  double high = voxel_m * 2;
  while (!fitsAt(high)) high *= 2;
  for (int i = 0; i < 60; ++i) (fitsAt((low + high) / 2) ? high : low) = (low + high) / 2;
  return rounded(high);
}

constexpr const char* kScaleHelps = "a scale for the meshes makes all of it larger or smaller";

void requireEdge(double voxel_m) {
  if (voxel_m >= kLeastVoxel_m && voxel_m <= kMostVoxel_m) return;
  throw InputError(fmt::format("voxels of {:.4g} m; expected {} to {:.0f} m: {}", voxel_m, kLeastVoxel_m,
                               kMostVoxel_m, kScaleHelps));
}

}  // namespace

void requireFits(Vec3 size, double voxel_m, const WorldUse& use) {
  if (!(voxel_m > 0) || !std::isfinite(voxel_m)) {
    throw InputError(fmt::format("voxel size {} m: expected a positive length", voxel_m));
  }
  const double longest = std::max({size.x, size.y, size.z});
  if (!std::isfinite(longest)) {
    throw InputError(fmt::format("voxel size {} m: too small to count the voxels of this world", voxel_m));
  }
  if (!(std::min({size.x, size.y, size.z}) >= 1)) {
    throw InputError(
        fmt::format("a world of {:.0f} x {:.0f} x {:.0f} voxels: expected at least one along each axis",
                    size.x, size.y, size.z));
  }
  if (fits(size, use)) return requireEdge(voxel_m);
  const std::string reason =
      longest > kLongestAxis ? fmt::format("has more than {} voxels along an axis", kLongestAxis)
                             : fmt::format("needs {} of memory, and {} are free for it here",
                                           inGigabytes(worldBytes(size, use)), inGigabytes(memoryBudget()));
  const double fitting_m = fittingVoxel(size, voxel_m, use);
  throw InputError(fmt::format("a world of {:.15g} x {:.15g} x {:.15g} voxels of {:.6g} m {}; {}", size.x,
                               size.y, size.z, voxel_m, reason,
                               fitting_m <= kMostVoxel_m
                                   ? fmt::format("a voxel size of {:.6g} m would fit", fitting_m)
                                   : fmt::format("expected it smaller: {}", kScaleHelps)));
}

void requireFits(const Frame& frame, const WorldUse& use) {
  requireFits(Vec3(frame.size), frame.voxel_m, use);
}

void requireFilledFits(std::size_t voxels, const std::string& object) {
  constexpr double kBytesPerVoxel = 50.0;  // grids of surfaces and layers
  const double bytes = static_cast<double>(voxels) * kBytesPerVoxel;
  if (bytes <= memoryBudget()) return;
  throw InputError(
      fmt::format("{}: filling it takes {} voxels and {} of memory, and {} are free for it here; expected "
                  "larger voxels or a surface that is not filled",
                  object, voxels, inGigabytes(bytes), inGigabytes(memoryBudget())));
}

}  // namespace espalier::sim
