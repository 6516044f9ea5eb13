#include "sim/light/horizons.h"

#include <algorithm>
#include <cstdlib>

#include "sim/base/bricks.h"
#include "sim/base/parallel.h"

namespace espalier::sim {
namespace {

constexpr int kSide = Bricks::kSide;

/// Places on a map are fixed-point numbers. A world is at most 16,000 voxels long, and a place at most twice
/// as much: 31 bits.
constexpr int kFraction = 16;
constexpr std::int32_t kUnit = 1 << kFraction;

/// A ray from the centre of a voxel crosses others whose places differ from its own by up to half a voxel and
/// half the slope. An eighth more, as slopes are rounded.
std::int32_t margin(std::int32_t slope) {
  return kUnit / 2 + std::abs(slope) / 2 + kUnit / 8;
}

/// Of a map. All of them together take no more memory than half the volume's bits.
std::size_t mostSquares(Voxel size, std::size_t directions) {
  constexpr std::size_t kMost = std::size_t{1} << 16, kBits = 16, kVoxels = 2 * kBits;
  const std::size_t voxels =
      static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
  return std::clamp(voxels / (kVoxels * std::max<std::size_t>(1, directions)), std::size_t{1}, kMost);
}

std::size_t padded(std::size_t directions) {
  return (directions + Horizons::kLanes - 1) / Horizons::kLanes * Horizons::kLanes;
}

std::int32_t valueOf(const Horizons::Linear& linear, std::size_t i, Voxel v) {
  return linear.x[i] * v.x + linear.y[i] * v.y + linear.z[i] * v.z + linear.rest[i];
}

}  // namespace

Horizons::Horizons(Voxel size, std::span<const LatticeDirection> directions) {
  const Voxel bricks = (size + (kSide - 1)) / kSide, whole = bricks * kSide;
  std::vector<std::array<std::int32_t, 2>> ends;  // of each direction's places
  for (const LatticeDirection& direction : directions) {
    const Voxel v = direction.v;
    Map& map = maps_.emplace_back();
    map.axis = depthAxis(v);
    map.bricks = v[map.axis] < 0 ? bricks[map.axis] : 0;
    auto& end = ends.emplace_back();
    for (std::size_t k = 0; k < 2; ++k) {
      Across& across = map.across[k];
      across.axis = (map.axis + 1 + static_cast<int>(k)) % 3;
      across.slope = v[across.axis] * kUnit / v[map.axis];
      // All places are to be positive, and the margins too.
      across.rest = std::max(0, across.slope) * (whole[map.axis] - 1) + margin(across.slope);
      end[k] = (whole[across.axis] - 1) * kUnit - std::min(0, across.slope) * (whole[map.axis] - 1) +
               across.rest + margin(across.slope);
    }
  }
  const auto squaresOf = [&](std::size_t i) {
    return (static_cast<std::size_t>(ends[i][0] >> shift_) + 1) *
           (static_cast<std::size_t>(ends[i][1] >> shift_) + 1);
  };
  const std::size_t most = mostSquares(size, directions.size());
  shift_ = kFraction + 3;  // a brick's side
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    while (squaresOf(i) > most) ++shift_;
  }
  const std::size_t count = padded(maps_.size());
  for (Linear* const linear : {&depth_, &place_[0], &place_[1]}) {
    for (auto* const numbers : {&linear->x, &linear->y, &linear->z, &linear->rest}) numbers->resize(count);
  }
  line_.resize(count);
  first_.resize(count);
  std::size_t squares = 0;
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    Map& map = maps_[i];
    const auto ofAxis = [&](Linear& linear, int axis) -> std::int32_t& {
      return (axis == 0 ? linear.x : axis == 1 ? linear.y : linear.z)[i];
    };
    ofAxis(depth_, map.axis) = map.bricks > 0 ? -1 : 1;
    depth_.rest[i] = map.bricks > 0 ? kSide * map.bricks - 1 : 0;
    for (std::size_t k = 0; k < 2; ++k) {
      ofAxis(place_[k], map.across[k].axis) = kUnit;
      ofAxis(place_[k], map.axis) = -map.across[k].slope;
      place_[k].rest[i] = map.across[k].rest;
    }
    map.line = line_[i] = (ends[i][0] >> shift_) + 1;
    map.first = first_[i] = static_cast<std::int32_t>(squares);
    squares += (squaresOf(i) + 1) / 2 * 2;  // no word is shared by two maps
  }
  squares_.resize(squares / 2 + 1);
}

void Horizons::raise(const Map& map, Voxel brick) {
  const std::int32_t near = kSide * brick[map.axis], far = near + kSide - 1;
  std::array<std::int32_t, 2> low, high;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& [axis, slope, rest] = map.across[k];
    const std::int32_t at = kSide * brick[axis] * kUnit + rest;
    low[k] = (at - std::max(slope * near, slope * far) - margin(slope)) >> shift_;
    high[k] = (at + (kSide - 1) * kUnit - std::min(slope * near, slope * far) + margin(slope)) >> shift_;
  }
  const auto depth =
      static_cast<std::uint32_t>(map.bricks > 0 ? map.bricks - brick[map.axis] : brick[map.axis] + 1);
  for (std::int32_t line = low[1]; line <= high[1]; ++line) {
    for (std::int32_t column = low[0]; column <= high[0]; ++column) {
      const auto square = static_cast<std::size_t>(map.first + line * map.line + column);
      std::uint32_t& two = squares_[square / 2];
      const std::uint32_t at = 16 * (square % 2);
      if (((two >> at) & 0xffffu) < depth) two = (two & (0xffff0000u >> at)) | depth << at;
    }
  }
}

void Horizons::raise(std::span<const Voxel> bricks) {
  if (bricks.empty()) return;
  parallelFor(maps_.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (const Voxel brick : bricks) raise(maps_[i], brick);
    }
  });
}

int Horizons::reach(std::size_t i, Voxel voxel) const {
  const auto square =
      static_cast<std::size_t>(first_[i] + (valueOf(place_[1], i, voxel) >> shift_) * line_[i] +
                               (valueOf(place_[0], i, voxel) >> shift_));
  const auto bricks = static_cast<int>((squares_[square / 2] >> (16 * (square % 2))) & 0xffffu);
  return kSide * bricks - 1 - valueOf(depth_, i, voxel);
}

}  // namespace espalier::sim
