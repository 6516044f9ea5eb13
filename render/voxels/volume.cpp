#include "render/voxels/volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/error.h"
#include "sim/base/memory.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"

namespace espalier::render {
namespace {

using sim::Voxel;

constexpr double kStepsInVoxel = 4.0;
/// Below this nothing that comes behind can be told in a picture.
constexpr float kLeastLeft = 1.0f / 1024.0f;
constexpr double kNear_vx = 1.0;
/// How far from a free voxel a ray may get through full ones: half a voxel is opaque, and a voxel's value is
/// felt a width to all sides.
constexpr int kDeepest = 2;
/// Of light that takes a step through voxels of a share, how much goes on. Through a whole voxel it is
/// (1 - share^3)^5. The cube, because a ray that passes along a solid's face goes a long way through voxels
/// that are little taken: these have to stay clear, or it is their outer rim that is seen, which has steps.
/// The fifth power, because a sheet of one layer of voxels is thinned to both sides, where values run evenly,
/// and has to hide what is behind it: with it 98 % of that.
float passes(float share) {
  const float clear = 1.0f - std::min(share * share * share, 1.0f);
  return clear * std::sqrt(std::sqrt(clear));
}

constexpr std::int32_t kToMake = -3;

/// Whether all voxels as near as kDeepest are full too.
bool isDeep(const sim::BitVolume& full, Voxel v) {
  const Voxel low = v - kDeepest, high = v + kDeepest;
  if (!sim::contains(full.size(), low) || !sim::contains(full.size(), high)) return false;
  constexpr std::uint64_t kWidth = (std::uint64_t{1} << (2 * kDeepest + 1)) - 1;
  for (int y = low.y; y <= high.y; ++y) {
    for (int z = low.z; z <= high.z; ++z) {
      if ((full.from({low.x, y, z}) & kWidth) != kWidth) return false;
    }
  }
  return true;
}

/// Where a ray enters and leaves a box from 0 to `size`; the first is greater where it misses it.
std::pair<double, double> within(sim::Vec3 from, sim::Vec3 way, sim::Vec3 size) {
  double enters = 0.0, leaves = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0.0) {
      if (from[axis] < 0.0 || from[axis] >= size[axis]) return {1.0, 0.0};
      continue;
    }
    const double a = -from[axis] / way[axis], b = (size[axis] - from[axis]) / way[axis];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return {enters, leaves};
}

}  // namespace

// Values are kept by cells, whose corners are the centres of voxels: cell 0 reaches from voxel -1 to voxel 0.
Volume::Volume(const sim::Frame& frame, const sim::BitVolume& occupied, const sim::BitVolume& full,
               const std::function<VolumeVoxel(Voxel)>& look)
    : frame_(frame), count_((frame.size + 1 + (kSide - 1)) / kSide) {
  const Voxel count = count_;
  number_.resize(static_cast<std::size_t>(count.x) * static_cast<std::size_t>(count.y) *
                 static_cast<std::size_t>(count.z));
  const auto lowOf = [&](std::size_t i) {
    const auto along = [](std::size_t n) { return static_cast<int>(n) * kSide - 1; };
    const auto x = static_cast<std::size_t>(count.x), z = static_cast<std::size_t>(count.z);
    return Voxel(along(i % x), along(i / x / z), along(i / x % z));
  };
  sim::parallelFor(number_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Voxel low = lowOf(i);
      bool any = false, deep = true;
      for (int n = 0; n < kValues * kValues * kValues && (deep || !any); ++n) {
        const Voxel v = low + Voxel(n % kValues, n / kValues / kValues, n / kValues % kValues);
        any = any || occupied.at(v);
        deep = deep && full.at(v) && isDeep(full, v);
      }
      number_[i] = deep ? kDeep : any ? kToMake : kEmpty;
    }
  });
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < number_.size(); ++i) {
    if (number_[i] != kToMake) continue;
    number_[i] = static_cast<std::int32_t>(places.size());
    places.push_back(i);
  }
  const double bytes = static_cast<double>(places.size()) * sizeof(Brick);
  if (bytes > sim::memoryBudget()) {
    throw sim::InputError(fmt::format(
        "an image of kind volume needs {} of memory in this world, and {} are free for it here; expected "
        "larger voxels",
        sim::inGigabytes(bytes), sim::inGigabytes(sim::memoryBudget())));
  }
  bricks_.resize(places.size());
  sim::parallelForEach(places.size(), [&](std::size_t b) {
    sim::throwIfStopped();
    const Voxel low = lowOf(places[b]);
    Brick& brick = bricks_[b];
    for (int n = 0; n < kValues * kValues * kValues; ++n) {
      const Voxel corner(n % kValues, n / kValues / kValues, n / kValues % kValues), v = low + corner;
      if (!occupied.at(v)) continue;
      Value& value = brick.values[static_cast<std::size_t>(n)];
      if (full.at(v) && isDeep(full, v)) {
        value[3] = 1.0f;
      } else {
        const VolumeVoxel there = look(v);
        const float share = std::clamp(there.share, 0.0f, 1.0f);
        value = {share * there.light.r, share * there.light.g, share * there.light.b, share};
      }
      if (value[3] == 0.0f) continue;
      for (int around = 0; around < 8; ++around) {
        const Voxel cell = corner - Voxel(around & 1, around >> 1 & 1, around >> 2);
        if (sim::contains(Voxel(kSide), cell))
          brick.taken[static_cast<std::size_t>(cell.y)] |= std::uint64_t{1} << (cell.z << 3 | cell.x);
      }
    }
  });
}

double Volume::bytes() const {
  return static_cast<double>(bricks_.size()) * sizeof(Brick);
}

float shareOfThin(float stops) {
  return std::cbrt(std::clamp(stops, 0.0f, 1.0f));
}

inline Volume::Value Volume::valueIn(const Brick& brick, Voxel cell, sim::Vec3f part) {
  const Value* const corner =
      &brick.values[static_cast<std::size_t>((cell.y * kValues + cell.z) * kValues + cell.x)];
  Value sum{};
  for (int dy = 0; dy < 2; ++dy) {
    for (int dz = 0; dz < 2; ++dz) {
      const float weight = (dy != 0 ? part.y : 1.0f - part.y) * (dz != 0 ? part.z : 1.0f - part.z);
      const Value* const a = corner + (dy * kValues + dz) * kValues;
      for (std::size_t c = 0; c < sum.size(); ++c)
        sum[c] += weight * ((1.0f - part.x) * a[0][c] + part.x * a[1][c]);
    }
  }
  return sum;
}

Volume::Seen Volume::along(sim::Vec3 from_m, sim::Vec3 direction) const {
  const sim::Vec3 from = sim::voxelFromWorld(frame_, from_m) + 1.0;
  const auto [enters, leaves] = within(from, direction, sim::Vec3(frame_.size) + 1.0);
  const sim::Vec3 way = direction / kStepsInVoxel, steps = 1.0 / way;  // for a width along each axis
  const Voxel ahead(way.x > 0.0, way.y > 0.0, way.z > 0.0), most = frame_.size;
  Seen seen;
  float left = 1.0f;
  // Steps are counted from the eye, whatever is passed over.
  double step = std::ceil(std::max(enters, kNear_vx) * kStepsInVoxel);
  const double last = std::min(leaves * kStepsInVoxel, 1e9);
  while (step < last && left >= kLeastLeft) {
    const sim::Vec3 at = from + step * way;
    const Voxel all = glm::clamp(Voxel(at), Voxel(0), most);  // its cell among all
    const Voxel brick = all / kSide, cell = all - brick * kSide;
    const std::int32_t number = brickAt(brick);
    if (number == kDeep) break;
    if (number == kEmpty) {
      double out = 1e9;
      for (int axis = 0; axis < 3; ++axis) {
        if (way[axis] != 0.0)
          out = std::min(out, (kSide * (brick[axis] + ahead[axis]) - at[axis]) * steps[axis]);
      }
      step = std::max(step + 1.0, std::ceil(step + out));
      continue;
    }
    step += 1.0;
    const Brick& here = bricks_[static_cast<std::size_t>(number)];
    if ((here.taken[static_cast<std::size_t>(cell.y)] >> (cell.z << 3 | cell.x) & 1u) == 0) continue;
    const Value value = valueIn(here, cell, glm::clamp(sim::Vec3f(at - sim::Vec3(all)), 0.0f, 1.0f));
    if (!(value[3] > 0.0f)) continue;
    const float on = passes(value[3]);
    const float by = left * (1.0f - on) / value[3];
    seen.light += by * sim::Colour(value[0], value[1], value[2]);
    left *= on;
  }
  if (left < kLeastLeft) {  // as if the rest were like what is seen
    seen.light /= 1.0f - left;
    left = 0.0f;
  }
  seen.opacity = 1.0f - left;
  return seen;
}

Image marchThrough(const Volume& volume, const Camera& camera, int width_px, int height_px) {
  if (width_px < 1 || height_px < 1)
    throw sim::InputError(
        fmt::format("a picture of {} x {} pixels; expected at least one", width_px, height_px));
  const CameraRays rays(camera, static_cast<double>(width_px) / height_px);
  Image image(width_px, height_px, 4);
  sim::parallelForEach(static_cast<std::size_t>(height_px), [&](std::size_t row) {
    sim::throwIfStopped();
    const int y = static_cast<int>(row);
    for (int x = 0; x < width_px; ++x) {
      Volume::Seen mean;
      for (int ray = 0; ray < 4; ++ray) {
        const double across = x + 0.25 + 0.5 * (ray % 2), down = y + 0.25 + 0.5 * (ray / 2);
        const Volume::Seen seen =
            volume.along(rays.eye_m(), rays.direction(across / width_px, down / height_px));
        mean.light += 0.25f * seen.light;
        mean.opacity += 0.25f * seen.opacity;
      }
      std::copy_n(&mean.light.r, 3, image.at(x, y));
      image.at(x, y)[3] = mean.opacity;
    }
  });
  return image;
}

}  // namespace espalier::render
