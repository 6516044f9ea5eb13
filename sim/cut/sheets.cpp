#include "sim/cut/sheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "sim/base/parallel.h"
#include "sim/base/random.h"

namespace espalier::sim {
namespace {

double squaredToLine(Vec3 from, Vec3 way, Vec3 p) {
  const double length2 = glm::dot(way, way);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - from, way) / length2, 0.0, 1.0) : 0.0;
  const Vec3 off = p - (from + t * way);
  return glm::dot(off, off);
}

/// Half the diagonal between the middles of a block's outermost voxels.
const double kBlockReach = 0.5 * (kBlock - 1) * std::sqrt(3.0);

int blockOf(double voxel) {
  return static_cast<int>(std::floor(voxel / kBlock));
}

}  // namespace

double distanceTo(const Sheet& sheet, Vec3 p) {
  const Vec3 u = sheet.along, v = sheet.across, q = p - sheet.at;
  const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
  const double area2 = uu * vv - uv * uv;
  if (area2 > 1e-9 * uu * vv) {
    const double qu = glm::dot(q, u), qv = glm::dot(q, v);
    const double s = (qu * vv - qv * uv) / area2, t = (qv * uu - qu * uv) / area2;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) return glm::length(q - (s * u + t * v));
  }
  return std::sqrt(std::min({squaredToLine(sheet.at, u, p), squaredToLine(sheet.at, v, p),
                             squaredToLine(sheet.at + v, u, p), squaredToLine(sheet.at + u, v, p)}));
}

Straying::Straying(double amplitude, double longest, double shortest, std::uint64_t stream)
    : table_(static_cast<std::size_t>(kSide) * kSide * kSide * 3) {
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        Slots slots(keyAt(stream, {x, y, z}), Purpose::rough);
        float* const at = table_.data() +
                          3 * (static_cast<std::size_t>(z * kSide + y) * kSide + static_cast<std::size_t>(x));
        for (unsigned k = 0; k < 3; ++k) at[k] = 2.0f * slots.uniformFloat(k) - 1.0f;
      }
    }
  }
  // What even numbers between -1 and 1 at corners, smooth between them, are in the mean of squares.
  constexpr double kMeanOfTable = 0.37, kFalls = 0.55;
  double squares = 0.0, share = 1.0;
  for (double length = longest; octaves_.empty() || length >= shortest; length *= 0.5, share *= kFalls) {
    octaves_.push_back({1.0 / length, share});
    squares += share * share;
  }
  for (Octave& octave : octaves_) octave.amplitude *= amplitude / (kMeanOfTable * std::sqrt(squares));
}

double Straying::farthest() const {
  double sum = 0.0;
  for (const Octave& octave : octaves_) sum += octave.amplitude;
  return sum;
}

Vec3 Straying::operator()(Vec3 p) const {
  Vec3 sum(0.0);
  for (std::size_t i = 0; i < octaves_.size(); ++i) {
    // Each octave from a corner of its own, or all would be still at the origin.
    const Vec3 at = octaves_[i].per_voxel * p + 7.31 * static_cast<double>(i + 1);
    std::array<std::array<std::size_t, 2>, 3> corner;
    Vec3 part;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = std::floor(at[axis]), t = at[axis] - low;
      const int wrapped = static_cast<int>(low - kSide * std::floor(low / kSide));
      corner[static_cast<std::size_t>(axis)] = {static_cast<std::size_t>(wrapped),
                                                static_cast<std::size_t>((wrapped + 1) % kSide)};
      part[axis] = t * t * (3.0 - 2.0 * t);
    }
    for (unsigned k = 0; k < 8; ++k) {
      const std::size_t x = corner[0][k & 1], y = corner[1][k >> 1 & 1], z = corner[2][k >> 2];
      const float* const value = table_.data() + 3 * ((z * kSide + y) * kSide + x);
      const double weight = (k & 1 ? part.x : 1.0 - part.x) * (k >> 1 & 1 ? part.y : 1.0 - part.y) *
                            (k >> 2 ? part.z : 1.0 - part.z);
      sum += octaves_[i].amplitude * weight * Vec3(value[0], value[1], value[2]);
    }
  }
  return sum;
}

void StrayedBlock::stray(Voxel origin, const std::function<Vec3(Vec3)>& straying) {
  std::size_t i = 0;
  for (int x = 0; x < kBlock; ++x) {
    for (int y = 0; y < kBlock; ++y) {
      for (int z = 0; z < kBlock; ++z, ++i) {
        place[i] = Vec3(origin + Voxel(x, y, z));
        if (straying) place[i] += straying(place[i]);
      }
    }
  }
}

void StrayedBlock::measure(std::span<const std::uint32_t> some, std::span<const Sheet> sheets, double most) {
  // Of most sheets that may be near to a block none of its voxels is: those need a look from its middle
  // alone.
  Vec3 low = place[0], high = place[0];
  for (const Vec3& p : place) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const Vec3 middle = 0.5 * (low + high);
  const double around = 0.5 * glm::length(high - low);
  std::vector<std::pair<double, std::uint32_t>> away;
  double nearest = most;
  for (const std::uint32_t sheet : some) {
    away.emplace_back(distanceTo(sheets[sheet], middle), sheet);
    nearest = std::min(nearest, away.back().first);
  }
  // With some air for roundings.
  const double farthest = std::min(most + around, nearest + 2.0 * around) + 1e-6;
  std::erase_if(away, [&](const auto& one) { return one.first > farthest; });
  for (std::size_t i = 0; i < kVoxels; ++i) {
    distance[i] = most;
    for (const auto& [from_middle, sheet] : away)
      distance[i] = std::min(distance[i], distanceTo(sheets[sheet], place[i]));
  }
}

std::vector<NearSheets> blocksNear(std::span<const Sheet> sheets, double reach, Voxel low, Voxel high) {
  std::vector<std::vector<Voxel>> of_each(sheets.size());
  parallelForEach(sheets.size(), [&](std::size_t i) {
    const Sheet& sheet = sheets[i];
    Vec3 least = sheet.at, most = sheet.at;
    for (const Vec3& corner :
         {sheet.at + sheet.along, sheet.at + sheet.across, sheet.at + sheet.along + sheet.across}) {
      least = glm::min(least, corner);
      most = glm::max(most, corner);
    }
    least = glm::max(least - reach, Vec3(low));
    most = glm::min(most + reach, Vec3(high));
    for (int x = blockOf(least.x); x <= blockOf(most.x); ++x) {
      for (int y = blockOf(least.y); y <= blockOf(most.y); ++y) {
        for (int z = blockOf(least.z); z <= blockOf(most.z); ++z) {
          const Vec3 middle = Vec3(kBlock * Voxel(x, y, z)) + 0.5 * (kBlock - 1);
          if (distanceTo(sheet, middle) <= reach + kBlockReach) of_each[i].emplace_back(x, y, z);
        }
      }
    }
  });
  std::vector<std::tuple<int, int, int, std::uint32_t>> all;
  for (std::size_t i = 0; i < of_each.size(); ++i)
    for (const Voxel& block : of_each[i])
      all.emplace_back(block.x, block.y, block.z, static_cast<std::uint32_t>(i));
  std::sort(all.begin(), all.end());
  std::vector<NearSheets> near;
  for (const auto& [x, y, z, sheet] : all) {
    const Voxel origin = kBlock * Voxel(x, y, z);
    if (near.empty() || near.back().origin != origin) near.push_back({origin, {}});
    near.back().sheets.push_back(sheet);
  }
  return near;
}

}  // namespace espalier::sim
