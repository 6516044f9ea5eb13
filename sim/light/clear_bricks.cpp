#include "sim/light/clear_bricks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <map>
#include <tuple>

#include "sim/base/parallel.h"
#include "sim/light/look.h"
#include "sim/sweep/lanes.h"

namespace espalier::sim {
namespace {

constexpr int kSide = ClearBricks::kSide;

/// Bit b of the result: whether byte b holds anything.
std::uint64_t bytesThatHoldAnything(std::uint64_t word) {
  word |= word >> 4;
  word |= word >> 2;
  word |= word >> 1;
  return ((word & 0x0101010101010101u) * 0x0102040810204080u) >> 56;
}

/// Calls visit(brick) for each brick that holds anything.
template <typename Visit>
void forEachFilled(const BitVolume& occupied, const Visit& visit) {
  const Voxel size = occupied.size();
  const auto words = static_cast<std::size_t>(occupied.rowWords() - 1);
  std::vector<std::uint64_t> united(words);
  for (int y = 0; y * kSide < size.y; ++y) {
    for (int z = 0; z * kSide < size.z; ++z) {
      std::fill(united.begin(), united.end(), 0);
      for (int dy = kSide * y; dy < std::min(size.y, kSide * (y + 1)); ++dy) {
        for (int dz = kSide * z; dz < std::min(size.z, kSide * (z + 1)); ++dz) {
          const std::uint64_t* const row = occupied.row(dy, dz);
          for (std::size_t w = 0; w < words; ++w) united[w] |= row[w];
        }
      }
      for (std::size_t w = 0; w < words; ++w) {
        for (std::uint64_t bricks = bytesThatHoldAnything(united[w]); bricks != 0; bricks &= bricks - 1)
          visit(Voxel(static_cast<int>(8 * w) + std::countr_zero(bricks), y, z));
      }
    }
  }
}

/// How often bricks are to be halved in number along each axis until a row along the shortest fits into a
/// lane, and all of them into memory.
int halvings(Voxel bricks) {
  constexpr std::size_t kMostBricks = std::size_t{1} << 21;
  for (int n = 0;; ++n) {
    const Voxel left = ((bricks - 1) >> Voxel(n)) + 1;
    const std::size_t all = static_cast<std::size_t>(left.x) * static_cast<std::size_t>(left.y) *
                            static_cast<std::size_t>(left.z);
    if (std::min({left.x, left.y, left.z}) <= 64 && all <= kMostBricks) return n;
  }
}

/// Bricks' bits so that all bricks of a row along the world's shortest axis lie in one lane, and lanes lie
/// densely: a step along that axis is a shift, one along the others a step in memory.
struct Layout {
  int lane, row, column;   // axes: bits of a lane, lanes of a line, lines
  std::size_t lane_bytes;  // 1, 2, 4 or 8
  int lanes, lines;
  std::size_t line_bytes;  // whole words, and one more

  explicit Layout(Voxel bricks) {
    std::array<int, 3> axes{0, 1, 2};
    std::sort(axes.begin(), axes.end(), [&](int a, int b) { return bricks[a] < bricks[b]; });
    lane = axes[0], column = axes[1], row = axes[2];
    lane_bytes = std::bit_ceil((static_cast<std::size_t>(bricks[lane]) + 7) / 8);
    lanes = bricks[row], lines = bricks[column];
    line_bytes = (static_cast<std::size_t>(lanes) * lane_bytes + 15) / 8 * 8;
  }
  std::size_t bytes() const { return static_cast<std::size_t>(lines) * line_bytes; }
  std::size_t byteOf(Voxel brick) const {
    return static_cast<std::size_t>(brick[column]) * line_bytes +
           static_cast<std::size_t>(brick[row]) * lane_bytes;
  }
};

using Plane = std::vector<std::uint8_t>;

std::uint64_t load(const std::uint8_t* from) {
  std::uint64_t word;
  std::memcpy(&word, from, 8);
  return word;
}

/// The bits of a word's lanes that a shift of `by` leaves in their lane.
std::uint64_t kept(std::size_t lane_bytes, int by) {
  const std::size_t bits = 8 * lane_bytes;
  const std::uint64_t lane = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  const std::uint64_t mask = by >= 0 ? lane >> by : (lane << -by) & lane;
  std::uint64_t all = 0;
  for (std::size_t at = 0; at < 64; at += bits) all |= mask << at;
  return all;
}

/// into(b) |= from(b + step).
void unite(const Layout& layout, const Plane& from, Voxel step, Plane& into) {
  const int by = step[layout.lane];
  if (std::abs(by) >= static_cast<int>(8 * layout.lane_bytes)) return;
  const std::uint64_t mask = kept(layout.lane_bytes, by);
  const int along = step[layout.row], across = step[layout.column];
  const int lanes = layout.lanes - std::abs(along), lines = layout.lines - std::abs(across);
  if (lanes <= 0 || lines <= 0) return;
  const auto at = [&](int line, int lane) {
    return static_cast<std::size_t>(std::max(0, line)) * layout.line_bytes +
           static_cast<std::size_t>(std::max(0, lane)) * layout.lane_bytes;
  };
  looking::uniteShifted(into.data() + at(-across, -along), from.data() + at(across, along),
                        {static_cast<std::size_t>(lines), static_cast<std::size_t>(lanes) * layout.lane_bytes,
                         layout.line_bytes},
                        by, mask);
}

}  // namespace

ClearBricks::ClearBricks(const BitVolume& occupied, std::span<const LatticeDirection> directions)
    : size_(occupied.size()), bricks_((size_ + (kSide - 1)) / kSide), coarser_(halvings(bricks_)) {
  const Voxel size = ((bricks_ - 1) >> Voxel(coarser_)) + 1;
  const Layout layout(size);
  for (int axis = 0; axis < 3; ++axis) {
    Voxel one(0);
    one[axis] = 1;
    step_[static_cast<std::size_t>(axis)] = axis == layout.lane ? 1 : 8 * layout.byteOf(one);
  }
  Plane filled(layout.bytes() + 8);
  forEachFilled(occupied, [&](Voxel brick) {
    const Voxel judged = brick >> Voxel(coarser_);
    const auto bit = static_cast<std::size_t>(judged[layout.lane]);
    std::uint8_t& byte = filled[layout.byteOf(judged) + bit / 8];
    byte = static_cast<std::uint8_t>(byte | (1u << (bit % 8)));
  });
  // A brick on its way overlaps up to eight others at once: those from the one that holds its low corner on.
  std::map<std::tuple<int, int, int>, Plane> ahead;
  const auto sign = [](Voxel v) { return glm::sign(v); };
  for (const LatticeDirection& direction : directions) {
    const Voxel s = sign(direction.v);
    const auto [at, is_new] = ahead.try_emplace({s.x, s.y, s.z}, filled);
    if (!is_new) continue;
    for (int axis = 0; axis < 3; ++axis) {
      Voxel step(0);
      step[axis] = s[axis];
      const Plane before = at->second;
      if (s[axis] != 0) unite(layout, before, step, at->second);
    }
  }
  rows_.resize(kWords * 8 * layout.bytes(), ~std::uint64_t{0});
  const std::size_t groups = (directions.size() + 63) / 64;
  parallelForEach(groups, [&](std::size_t group) {
    const auto mine =
        directions.subspan(64 * group, std::min<std::size_t>(64, directions.size() - 64 * group));
    std::vector<Plane> blocked(mine.size(), Plane(layout.bytes() + 8));
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const Voxel v = glm::abs(mine[i].v), s = sign(mine[i].v);
      const Plane& from = ahead.at({s.x, s.y, s.z});
      for (Voxel o(0); o.x < size.x && o.y < size.y && o.z < size.z;) {
        unite(layout, from, o * s, blocked[i]);
        // The next plane between bricks: the least (o + 1) / v.
        int next = -1;
        for (int axis = 0; axis < 3; ++axis) {
          if (v[axis] != 0 && (next < 0 || (o[axis] + 1) * v[next] < (o[next] + 1) * v[axis])) next = axis;
        }
        const int time = o[next] + 1, length = v[next];
        for (int axis = 0; axis < 3; ++axis) {
          if (v[axis] != 0 && (o[axis] + 1) * length == time * v[axis]) ++o[axis];
        }
      }
    }
    for (std::size_t byte = 0; byte < layout.bytes(); byte += 8) {
      std::array<std::uint64_t, 64> square{};
      std::uint64_t any = 0;
      for (std::size_t i = 0; i < mine.size(); ++i) any |= square[i] = load(blocked[i].data() + byte);
      if (any == 0) continue;
      lanes::transpose(square.data());
      for (std::size_t bit = 0; bit < 64; ++bit) rows_[kWords * (8 * byte + bit) + group] = ~square[bit];
    }
  });
}

}  // namespace espalier::sim
