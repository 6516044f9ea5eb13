#include "sim/light/clear_bricks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <tuple>

#include "sim/base/parallel.h"
#include "sim/light/look.h"
#include "sim/sweep/lanes.h"

namespace espalier::sim {
namespace {

template <class Visit>
void forEachSet(const BitVolume& bits, Visit visit) {
  for (int y = 0; y < bits.size().y; ++y) {
    for (int z = 0; z < bits.size().z; ++z) {
      for (int w = 0; w < bits.rowWords(); ++w) {
        for (std::uint64_t word = bits.row(y, z)[w]; word != 0; word &= word - 1)
          visit(Voxel(w * BitVolume::kWordBits + std::countr_zero(word), y, z));
      }
    }
  }
}

std::size_t countOf(Voxel bricks) {
  return static_cast<std::size_t>(bricks.x) * static_cast<std::size_t>(bricks.y) *
         static_cast<std::size_t>(bricks.z);
}

/// Bricks' bits so that all bricks of a row along the world's shortest axis, at most 40 of 65,536, lie in one
/// lane, and the lanes of a line side by side: a step along that axis is a shift, one along the others a step
/// in memory.
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

bool ClearBricks::isCoarse(Voxel size) {
  constexpr std::size_t kMostBricks = std::size_t{1} << 16;  // all of them in the near caches
  return countOf((size + (kSide - 1)) / kSide) > kMostBricks;
}

ClearBricks::ClearBricks(Voxel size, const Bricks& filled, std::span<const LatticeDirection> directions)
    : size_(size), bricks_(filled.bits().size()), filled_(bricks_) {
  const Layout layout(bricks_);
  step_[static_cast<std::size_t>(layout.lane)] = 1;
  step_[static_cast<std::size_t>(layout.row)] = 8 * layout.lane_bytes;
  step_[static_cast<std::size_t>(layout.column)] = 8 * layout.bytes;
  rows_.resize(kWords * 8 * layout.allBytes());
  blocked_.resize(directions.size(), Plane(layout.allBytes()));
  for (const LatticeDirection& direction : directions)
    ahead_filled_[octantOf(direction.v)] = BitVolume(bricks_);
  forgetAll();
  follow(filled, directions);
}

void ClearBricks::forgetAll() {
  filled_ = BitVolume(filled_.size());
  for (BitVolume& octant : ahead_filled_) octant = BitVolume(octant.size());
  std::fill(rows_.begin(), rows_.end(), ~std::uint64_t{0});
  for (Plane& plane : blocked_) std::fill(plane.begin(), plane.end(), std::uint8_t{0});
}

void ClearBricks::addAhead(int y, int z, std::span<const std::uint64_t> came) {
  for (std::size_t octant = 0; octant < ahead_filled_.size(); ++octant) {
    BitVolume& to = ahead_filled_[octant];
    if (to.size().x == 0) continue;
    const int back_y = (octant & 2u) != 0 ? 1 : -1, back_z = (octant & 4u) != 0 ? 1 : -1;
    for (const int at_y : {y, y + back_y}) {
      for (const int at_z : {z, z + back_z}) {
        if (at_y < 0 || at_y >= bricks_.y || at_z < 0 || at_z >= bricks_.z) continue;
        std::uint64_t* const row = to.row(at_y, at_z);
        for (std::size_t w = 0; w < came.size(); ++w) {
          const std::uint64_t after = w + 1 < came.size() ? came[w + 1] : 0, before = w > 0 ? came[w - 1] : 0;
          row[w] |= came[w] | ((octant & 1u) != 0 ? came[w] << 1 | before >> 63 : came[w] >> 1 | after << 63);
        }
      }
    }
  }
}

std::vector<Voxel> ClearBricks::takeNote(const BitVolume& filled) {
  std::vector<Voxel> added;
  std::vector<std::uint64_t> all(static_cast<std::size_t>(filled.rowWords() - 1));
  for (int y = 0; y < bricks_.y; ++y) {
    for (int z = 0; z < bricks_.z; ++z) {
      std::uint64_t* const before = filled_.row(y, z);
      const std::uint64_t* const now = filled.row(y, z);
      std::uint64_t any = 0;
      for (std::size_t w = 0; w < all.size(); ++w) any |= all[w] = now[w] & ~before[w];
      if (any == 0) continue;
      addAhead(y, z, all);
      for (std::size_t w = 0; w < all.size(); ++w) {
        for (std::uint64_t came = all[w]; came != 0; came &= came - 1)
          added.emplace_back(static_cast<int>(w) * BitVolume::kWordBits + std::countr_zero(came), y, z);
        before[w] = now[w];
      }
    }
  }
  return added;
}

void ClearBricks::find(std::span<const LatticeDirection> directions) {
  const Layout layout(bricks_);
  ReadPlane filled(layout);
  forEachSet(filled_, [&](Voxel brick) { filled.set(brick); });
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
    const std::span<Plane> blocked = std::span(blocked_).subspan(64 * column, mine.size());
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const Voxel v = mine[i].v, sign = glm::sign(v);
      met.at({sign.x, sign.y, sign.z}).unite(wayOf(layout, bricks_, v), blocked[i]);
    }
    for (std::size_t byte = 0; byte < layout.allBytes(); byte += 8) {
      alignas(64) std::array<std::uint64_t, 64> square{};
      std::uint64_t any = 0;
      for (std::size_t i = 0; i < mine.size(); ++i) any |= square[i] = wordAt(blocked[i], byte);
      if (any == 0) continue;
      lanes::transpose(square.data());
      for (std::size_t bit = 0; bit < 64; ++bit) rows_[kWords * (8 * byte + bit) + column] = ~square[bit];
    }
  });
}

void ClearBricks::findAhead(std::span<const LatticeDirection> directions) {
  for (const LatticeDirection& direction : directions) {
    Ahead& ahead = ahead_.emplace_back();
    forEachAhead(bricks_, direction.v, [&](Voxel corner, Voxel brick) {
      ahead.corners.push_back(corner);
      ahead.bricks.push_back(brick);
      ahead.steps.push_back(static_cast<std::int32_t>(index(brick)));
    });
  }
}

void ClearBricks::addFilled(std::span<const Voxel> bricks, std::span<const LatticeDirection> directions) {
  if (ahead_.empty()) findAhead(directions);
  parallelForEach((directions.size() + 63) / 64, [&](std::size_t column) {
    for (std::size_t i = 64 * column; i < std::min<std::size_t>(64 * (column + 1), directions.size()); ++i) {
      const Ahead& ahead = ahead_[i];
      const std::uint64_t others = ~(std::uint64_t{1} << (i % 64));
      std::uint8_t* const blocked = blocked_[i].data();
      for (const Voxel brick : bricks) {
        const auto first = static_cast<std::ptrdiff_t>(index(brick));
        const auto block = [&](std::size_t k) {
          const auto from = static_cast<std::size_t>(first - ahead.steps[k]);
          const unsigned bit = 1u << (from % 8);
          if ((blocked[from / 8] & bit) != 0) return;
          blocked[from / 8] = static_cast<std::uint8_t>(blocked[from / 8] | bit);
          rows_[kWords * from + column] &= others;
        };
        const auto whileInside = [&](Voxel farther) {  // how many, as no others come from inside
          return static_cast<std::size_t>(
              std::partition_point(
                  ahead.corners.begin(), ahead.corners.end(),
                  [&](Voxel corner) { return contains(bricks_, brick - corner - farther); }) -
              ahead.corners.begin());
        };
        const std::size_t all = whileInside(Voxel(0));
        const std::size_t inside = std::min(all, whileInside(glm::sign(directions[i].v)));
        for (std::size_t k = 0; k < inside; ++k) block(k);
        for (std::size_t k = inside; k < all; ++k) {
          if (contains(bricks_, brick - ahead.bricks[k])) block(k);
        }
      }
    }
  });
}

void ClearBricks::follow(const Bricks& filled, std::span<const LatticeDirection> directions) {
  constexpr std::size_t kFew = 1000;  // adding one of so many bricks costs less than finding all anew
  const BitVolume& now = filled.bits();
  const auto emptied = [](std::uint64_t before, std::uint64_t after) { return (before & ~after) != 0; };
  if (!std::equal(filled_.words().begin(), filled_.words().end(), now.words().begin(), std::not_fn(emptied)))
    forgetAll();
  const std::vector<Voxel> added = takeNote(now);
  if (kFew * added.size() <= rows_.size() / kWords) {
    addFilled(added, directions);
  } else {
    find(directions);
  }
}

}  // namespace espalier::sim
