#include "sim/light/clear_bricks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <map>
#include <optional>
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

/// The bricks that hold anything, by their y.
std::vector<std::vector<Voxel>> filledBricks(const BitVolume& occupied) {
  const Voxel size = occupied.size();
  const auto words = static_cast<std::size_t>(occupied.rowWords() - 1);
  std::vector<std::vector<Voxel>> filled(static_cast<std::size_t>((size.y + kSide - 1) / kSide));
  parallelForEach(filled.size(), [&](std::size_t slab) {
    const int y = static_cast<int>(slab);
    std::vector<std::uint64_t> united(words);
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
          filled[slab].emplace_back(static_cast<int>(8 * w) + std::countr_zero(bricks), y, z);
      }
    }
  });
  return filled;
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

/// Bricks' bits so that all bricks of a row along the world's shortest axis lie in one lane, and the lanes of
/// a line side by side: a step along that axis is a shift, one along the others a step in memory.
struct Layout {
  int lane, column, row;   // axes: bits of a lane, lines, lanes of a line
  std::size_t lane_bytes;  // 1, 2, 4 or 8
  int lanes, lines;
  std::size_t bytes;    // of a line, in whole words
  std::size_t between;  // zeros between the lines of what is read: a step may lead as far

  explicit Layout(Voxel bricks) {
    std::array<int, 3> axes{0, 1, 2};
    std::sort(axes.begin(), axes.end(), [&](int a, int b) { return bricks[a] < bricks[b]; });
    lane = axes[0], column = axes[1], row = axes[2];
    lane_bytes = std::bit_ceil((static_cast<std::size_t>(bricks[lane]) + 7) / 8);
    lanes = bricks[row], lines = bricks[column];
    bytes = (static_cast<std::size_t>(lanes) * lane_bytes + 7) / 8 * 8;
    between = bytes + looking::kMostBytesAtOnce;
  }
  std::size_t allBytes() const { return static_cast<std::size_t>(lines) * bytes; }
  std::size_t apart() const { return bytes + between; }  // of lines that are read

  looking::Step step(Voxel o) const {
    const std::size_t bits = 8 * lane_bytes;
    const std::uint64_t whole = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    const std::uint64_t kept = o[lane] >= 0 ? whole >> o[lane] : (whole << -o[lane]) & whole;
    std::uint64_t mask = 0;
    for (std::size_t at = 0; at < 64; at += bits) mask |= kept << at;
    return {o[column],
            static_cast<std::ptrdiff_t>(o[column]) * static_cast<std::ptrdiff_t>(apart()) +
                static_cast<std::ptrdiff_t>(o[row]) * static_cast<std::ptrdiff_t>(lane_bytes),
            o[lane], mask};
  }
};

using Plane = std::vector<std::uint8_t>;  // a bit for each brick

/// Lines with zeros before, between and behind them.
class ReadPlane {
 public:
  explicit ReadPlane(const Layout& layout)
      : layout_(layout), bytes_(layout.between + static_cast<std::size_t>(layout.lines) * layout.apart()) {}

  void set(Voxel brick) {
    const auto bit = static_cast<std::size_t>(brick[layout_.lane]);
    std::uint8_t& byte =
        bytes_[layout_.between + static_cast<std::size_t>(brick[layout_.column]) * layout_.apart() +
               static_cast<std::size_t>(brick[layout_.row]) * layout_.lane_bytes + bit / 8];
    byte = static_cast<std::uint8_t>(byte | (1u << (bit % 8)));
  }
  /// For each brick, whether any is set at one of the steps from it.
  void unite(std::span<const looking::Step> steps, Plane& into) const {
    into.resize(layout_.allBytes() + looking::kMostBytesAtOnce);
    looking::uniteSteps(into.data(), layout_.bytes, bytes_.data() + layout_.between, layout_.apart(),
                        layout_.lines, layout_.bytes, steps);
  }
  /// Takes over what lies in the lines of a plane.
  void take(const Plane& plane) {
    for (std::size_t line = 0; line < static_cast<std::size_t>(layout_.lines); ++line) {
      std::copy_n(plane.begin() + static_cast<std::ptrdiff_t>(line * layout_.bytes),
                  static_cast<std::size_t>(layout_.lanes) * layout_.lane_bytes,
                  bytes_.begin() + static_cast<std::ptrdiff_t>(layout_.between + line * layout_.apart()));
    }
  }

 private:
  Layout layout_;
  std::vector<std::uint8_t> bytes_;
};

/// Where a brick's low corner comes to lie while it moves along v, up to the edge of the world; nearer ones
/// first.
template <class Visit>
void forEachOnWay(Voxel size, Voxel v, Visit visit) {
  const Voxel way = glm::abs(v), sign = glm::sign(v);
  for (Voxel o(0); o.x < size.x && o.y < size.y && o.z < size.z;) {
    visit(o * sign);
    int next = -1;  // the axis along which the next plane between bricks is met: the least (o + 1) / v
    for (int axis = 0; axis < 3; ++axis) {
      if (way[axis] != 0 && (next < 0 || (o[axis] + 1) * way[next] < (o[next] + 1) * way[axis])) next = axis;
    }
    const int planes = o[next] + 1, length = way[next];
    for (int axis = 0; axis < 3; ++axis) {
      if (way[axis] != 0 && (o[axis] + 1) * length == planes * way[axis]) ++o[axis];
    }
  }
}

std::vector<looking::Step> wayOf(const Layout& layout, Voxel size, Voxel v) {
  std::vector<looking::Step> steps;
  forEachOnWay(size, v, [&](Voxel o) { steps.push_back(layout.step(o)); });
  return steps;
}

/// Calls visit(o, at) for the bricks `at` that brick 0 overlaps on its way along v, each once, where its low
/// corner is in brick o.
template <class Visit>
void forEachAhead(Voxel size, Voxel v, Visit visit) {
  const Voxel sign = glm::sign(v), way = glm::abs(sign);
  std::optional<Voxel> before;
  forEachOnWay(size, v, [&](Voxel o) {
    for (int corner = 0; corner < 8; ++corner) {
      const Voxel out(corner & 1, (corner >> 1) & 1, corner >> 2);
      if (out != out * way) continue;  // it does not move along that axis
      const Voxel at = o + out * sign;
      // note: the way only goes on, so what was overlapped before was so a step ago.
      const Voxel since = before ? (at - *before) * sign : Voxel(2);
      if (since != glm::clamp(since, Voxel(0), way)) visit(o, at);
    }
    before = o;
  });
}

/// The bricks that a brick overlaps at once on its way, from the one that holds its low corner on.
std::vector<looking::Step> overlapped(const Layout& layout, Voxel sign) {
  std::vector<looking::Step> steps;
  for (const bool across : {false, true}) {  // those in the same line first
    if (across && sign[layout.column] == 0) break;
    for (int corner = 0; corner < 4; ++corner) {
      Voxel o(0);
      if (across) o[layout.column] = sign[layout.column];
      if ((corner & 1) != 0) o[layout.lane] = sign[layout.lane];
      if ((corner & 2) != 0) o[layout.row] = sign[layout.row];
      steps.push_back(layout.step(o));
    }
  }
  return steps;
}

std::uint64_t wordAt(const Plane& plane, std::size_t byte) {
  std::uint64_t word;
  std::memcpy(&word, plane.data() + byte, sizeof(word));
  return word;
}

}  // namespace

ClearBricks::ClearBricks(const BitVolume& occupied, std::span<const LatticeDirection> directions)
    : size_(occupied.size()),
      bricks_((size_ + (kSide - 1)) / kSide),
      coarser_(halvings(bricks_)),
      filled_(((bricks_ - 1) >> Voxel(coarser_)) + 1) {
  const Layout layout(filled_.size());
  step_[static_cast<std::size_t>(layout.lane)] = 1;
  step_[static_cast<std::size_t>(layout.row)] = 8 * layout.lane_bytes;
  step_[static_cast<std::size_t>(layout.column)] = 8 * layout.bytes;
  rows_.resize(kWords * 8 * layout.allBytes());
  find(directions, judgedBricks(occupied));
}

std::vector<Voxel> ClearBricks::judgedBricks(const BitVolume& occupied) {
  BitVolume judged(filled_.size());
  std::vector<Voxel> bricks;
  for (const auto& slab : filledBricks(occupied)) {
    for (const Voxel brick : slab) {
      const Voxel as_one = brick >> Voxel(coarser_);
      if (judged.at(as_one)) continue;
      judged.set(as_one);
      bricks.push_back(as_one);
    }
  }
  filled_ = std::move(judged);
  return bricks;
}

void ClearBricks::find(std::span<const LatticeDirection> directions, const std::vector<Voxel>& bricks) {
  const Voxel size = filled_.size();
  const Layout layout(size);
  ReadPlane filled(layout);
  for (const Voxel brick : bricks) filled.set(brick);
  std::map<std::tuple<int, int, int>, ReadPlane> met;  // by a brick whose low corner lies here, by v's signs
  for (const LatticeDirection& direction : directions) {
    const Voxel sign = glm::sign(direction.v);
    const auto [at, is_new] = met.try_emplace({sign.x, sign.y, sign.z}, layout);
    if (!is_new) continue;
    Plane plane;
    filled.unite(overlapped(layout, sign), plane);
    at->second.take(plane);
  }
  std::fill(rows_.begin(), rows_.end(), ~std::uint64_t{0});
  parallelForEach((directions.size() + 63) / 64, [&](std::size_t column) {
    const auto mine =
        directions.subspan(64 * column, std::min<std::size_t>(64, directions.size() - 64 * column));
    std::vector<Plane> blocked(mine.size());
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const Voxel v = mine[i].v, sign = glm::sign(v);
      met.at({sign.x, sign.y, sign.z}).unite(wayOf(layout, size, v), blocked[i]);
    }
    for (std::size_t byte = 0; byte < layout.allBytes(); byte += 8) {
      std::array<std::uint64_t, 64> square{};
      std::uint64_t any = 0;
      for (std::size_t i = 0; i < mine.size(); ++i) any |= square[i] = wordAt(blocked[i], byte);
      if (any == 0) continue;
      lanes::transpose(square.data());
      for (std::size_t bit = 0; bit < 64; ++bit) rows_[kWords * (8 * byte + bit) + column] = ~square[bit];
    }
  });
}

void ClearBricks::addFilled(std::span<const Voxel> judged, std::span<const LatticeDirection> directions) {
  if (ahead_.empty()) {
    for (const LatticeDirection& direction : directions) {
      std::vector<Ahead>& ahead = ahead_.emplace_back();
      forEachAhead(filled_.size(), direction.v, [&](Voxel o, Voxel at) { ahead.push_back({o, at}); });
    }
  }
  parallelForEach((directions.size() + 63) / 64, [&](std::size_t column) {
    for (std::size_t i = 64 * column; i < std::min<std::size_t>(64 * (column + 1), directions.size()); ++i) {
      const std::uint64_t others = ~(std::uint64_t{1} << (i % 64));
      for (const Voxel brick : judged) {
        for (const Ahead& ahead : ahead_[i]) {
          if (!contains(filled_.size(), brick - ahead.corner)) break;  // no other comes from inside
          const Voxel from = brick - ahead.brick;
          if (contains(filled_.size(), from)) rows_[kWords * indexJudged(from) + column] &= others;
        }
      }
    }
  });
}

void ClearBricks::follow(const BitVolume& occupied, std::span<const LatticeDirection> directions) {
  constexpr std::size_t kFew = 300;  // adding one of so many bricks costs less than finding all anew
  const BitVolume before = filled_;
  const std::vector<Voxel> bricks = judgedBricks(occupied);
  std::vector<Voxel> added;
  std::copy_if(bricks.begin(), bricks.end(), std::back_inserter(added),
               [&](Voxel brick) { return !before.at(brick); });
  const bool none_emptied = bricks.size() - added.size() == before.count();
  if (none_emptied && kFew * added.size() <= rows_.size() / kWords) {
    addFilled(added, directions);
  } else {
    find(directions, bricks);
  }
}

}  // namespace espalier::sim
