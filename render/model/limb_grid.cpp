#include "render/model/limb_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "sim/base/random.h"

namespace espalier::render {
namespace {

using sim::Vec3;

constexpr double kSameRing = 0.5;        // of a foot's length: a ring so near serves for its end
constexpr double kPart = 0.95;           // of the way between two feet that they may take up
constexpr double kLeastShare = 0.5;      // that is left of a foot which gives way to another
constexpr std::size_t kMostBeside = 64;  // feet at one place that are looked at
constexpr double kMiddle = 10.0;         // errors that a foot's half is to be worth a ring in its middle
constexpr double kFine = 4.0;            // errors that a radius is to be worth more columns
constexpr int kMostSides = 48;           // to which columns are doubled for the sake of feet
constexpr double kYield = 0.4;  // of a quad: how far a rim may leave its corners' own places outwards

/// Where a foot begins and ends: no farther than its limb reaches.
std::pair<double, double> endsOf(const Foot& foot, double length) {
  const double half = std::min(foot.half_arc_m, 0.45 * length);
  const double middle = std::clamp(foot.arc_m, half, length - half);
  return {middle - half, middle + half};
}

/// Rings at both ends of each foot, and at the stations between feet; in the middle of those feet that are
/// worth it.
std::vector<double> ringArcs(const Limb& limb, std::span<const Foot> standing, double error_m) {
  const double length = limb.length_m();
  std::vector<double> arcs = limb.arcs_m;
  for (const Foot& foot : standing) {
    const auto [low, high] = endsOf(foot, length);
    const Vec3 from = stationOn(limb, low).centre_m, step = stationOn(limb, high).centre_m - from;
    const auto straight = [&, first = low, last = high](double arc) {
      const Vec3 wanted = from + (arc - first) / (last - first) * step;
      return glm::distance(stationOn(limb, arc).centre_m, wanted) < 0.5 * limb.off_m;
    };
    const auto inner = std::upper_bound(arcs.begin() + 1, arcs.end() - 1, low);
    const auto outer = std::lower_bound(inner, arcs.end() - 1, high);
    arcs.erase(std::remove_if(inner, outer, straight), outer);
  }
  for (const Foot& foot : standing) {
    const auto [low, high] = endsOf(foot, length);
    const auto insert = [&](double arc, double apart) {
      const auto above = std::lower_bound(arcs.begin(), arcs.end(), arc);
      const bool near = (above != arcs.end() && *above - arc < apart) ||
                        (above != arcs.begin() && arc - *(above - 1) < apart);
      if (!near) arcs.insert(above, arc);
    };
    const double half = 0.5 * (high - low);
    insert(low, kSameRing * half);
    insert(high, kSameRing * half);
    if (half > kMiddle * error_m) insert(low + half, 0.7 * half);
  }
  return arcs;
}

int nearest(const std::vector<double>& arcs, double arc) {
  const auto above = std::lower_bound(arcs.begin(), arcs.end(), arc);
  if (above == arcs.begin()) return 0;
  const auto i = static_cast<int>(above - arcs.begin());
  return above == arcs.end() || arc - *(above - 1) < *above - arc ? i - 1 : i;
}

int wrapped(int column, int sides) {
  return ((column % sides) + sides) % sides;
}

/// Makes feet smaller where two overlap, in the way in which they have to give less.
void part(std::vector<Foot>& feet) {
  std::vector<std::size_t> order(feet.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return feet[a].arc_m < feet[b].arc_m; });
  double longest = 0.0;
  for (const Foot& foot : feet) longest = std::max(longest, foot.half_arc_m);
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      Foot &a = feet[order[i]], &b = feet[order[j]];
      const double along = b.arc_m - a.arc_m;
      if (along > a.half_arc_m + longest || j - i > kMostBeside) break;
      const double around = std::abs(std::remainder(b.angle - a.angle, 2.0 * kPi));
      const double share_along = kPart * along / (a.half_arc_m + b.half_arc_m);
      const double share_around = kPart * around / (a.half_angle + b.half_angle);
      if (std::max(share_along, share_around) >= 1.0) continue;
      const double share = std::max({share_along, share_around, kLeastShare});
      double Foot::*half = share_along > share_around ? &Foot::half_arc_m : &Foot::half_angle;
      a.*half *= share;
      b.*half *= share;
    }
  }
}

/// Which quads of a grid belong to patches.
class Places {
 public:
  Places(int sides, std::size_t rings)
      : sides_(sides),
        rows_(static_cast<int>(rings) - 1),
        taken_(static_cast<std::size_t>(sides) * (rings - 1), false) {}

  bool free(const Patch& patch) const {
    if (patch.row < 0 || patch.row + patch.rows > rows_ || patch.columns >= sides_) return false;
    for (int r = patch.row; r < patch.row + patch.rows; ++r) {
      for (int c = patch.column; c < patch.column + patch.columns; ++c)
        if (taken_[index(r, c)]) return false;
    }
    return true;
  }
  void take(const Patch& patch) {
    for (int r = patch.row; r < patch.row + patch.rows; ++r) {
      for (int c = patch.column; c < patch.column + patch.columns; ++c) taken_[index(r, c)] = true;
    }
  }
  /// The free quad nearest to the middle of a patch, widened to what is free of that patch. False where none
  /// is free.
  bool findRoom(Patch& patch) const {
    const Patch wish = patch;
    const double row = wish.row + 0.5 * wish.rows - 0.5, column = wish.column + 0.5 * wish.columns - 0.5;
    double best = -1.0;
    const auto look = [&](int r, double along) {
      for (int c = 0; c < sides_; ++c) {
        if (taken_[index(r, c)]) continue;
        const double around = std::remainder(c - column, sides_);
        const double distance = along + around * around;
        const bool first = r < patch.row || (r == patch.row && c < patch.column);
        if (best >= 0.0 && (distance > best || (distance == best && !first))) continue;
        best = distance;
        patch = {r, 1, c, 1, wish.foot};
      }
    };
    // From the middle to both sides, as far as a row can have a nearer one.
    const auto alongTo = [&](int r) { return (r - row) * (r - row); };
    int below = std::clamp(static_cast<int>(std::floor(row)), 0, rows_ - 1), above = below + 1;
    while (below >= 0 || above < rows_) {
      const bool down = above >= rows_ || (below >= 0 && alongTo(below) <= alongTo(above));
      int& next = down ? below : above;
      const double along = alongTo(next);
      if (best >= 0.0 && along > best) break;
      look(next, along);
      next += down ? -1 : 1;
    }
    if (best < 0.0) return false;
    const auto widen = [&](Patch wider, bool wanted) {
      if (wanted && free(wider)) patch = wider;
    };
    for (int i = 0; i < std::max(wish.rows, wish.columns); ++i) {
      const int from = wrapped(patch.column - wish.column, sides_);
      widen({patch.row, patch.rows + 1, patch.column, patch.columns, wish.foot},
            patch.row + patch.rows < wish.row + wish.rows);
      widen({patch.row - 1, patch.rows + 1, patch.column, patch.columns, wish.foot}, patch.row > wish.row);
      widen({patch.row, patch.rows, patch.column, patch.columns + 1, wish.foot},
            from + patch.columns < wish.columns);
      widen({patch.row, patch.rows, wrapped(patch.column - 1, sides_), patch.columns + 1, wish.foot},
            from > 0 && from < wish.columns);
    }
    return true;
  }

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row * sides_ + wrapped(column, sides_));
  }

  int sides_, rows_;
  std::vector<bool> taken_;
};

/// Twice as many rows.
void refine(std::vector<double>& arcs) {
  std::vector<double> finer;
  for (std::size_t i = 0; i + 1 < arcs.size(); ++i) {
    finer.push_back(arcs[i]);
    finer.push_back(0.5 * (arcs[i] + arcs[i + 1]));
  }
  finer.push_back(arcs.back());
  arcs = std::move(finer);
}

/// How many feet stand elsewhere than they wished to; nothing where one has found no room at all.
std::optional<std::size_t> place(LimbGrid& grid, std::span<const Foot> standing) {
  Places places(grid.sides, grid.arcs_m.size());
  std::vector<std::size_t> order(standing.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return standing[a].half_arc_m * standing[a].half_angle > standing[b].half_arc_m * standing[b].half_angle;
  });
  const double side = 2.0 * kPi / grid.sides;
  const int most = std::max(1, grid.sides - 2);
  std::size_t elsewhere = 0;
  grid.patches.assign(standing.size(), {});
  for (const std::size_t i : order) {
    const Foot& foot = standing[i];
    Patch& patch = grid.patches[i];
    patch.foot = foot;
    patch.columns = std::clamp(static_cast<int>(std::lround(2.0 * foot.half_angle / side)), 1, most);
    patch.column =
        wrapped(static_cast<int>(std::lround(foot.angle / side - 0.5 * patch.columns)), grid.sides);
    const auto [low, high] = endsOf(foot, grid.arcs_m.back());
    const int rings = static_cast<int>(grid.arcs_m.size());
    patch.row = std::min(nearest(grid.arcs_m, low), rings - 2);
    patch.rows = std::max(nearest(grid.arcs_m, high) - patch.row, 1);
    if (!places.free(patch)) {
      if (!places.findRoom(patch)) return {};
      ++elsewhere;
    }
    places.take(patch);
  }
  return elsewhere;
}

/// Puts a foot where its patch is, and no wider than the patch and a part of the quads around it.
void fit(Patch& patch, const LimbGrid& grid) {
  const double side = 2.0 * kPi / grid.sides;
  const auto within = [](double& middle, double& half, double low, double high) {
    half = std::min(half, 0.5 * (high - low));
    middle = std::clamp(middle, low + half, high - half);
  };
  const double left = side * patch.column;
  double angle = left + std::remainder(patch.foot.angle - left, 2.0 * kPi);
  // Of the turns of the angle the one next to the patch's middle.
  const double middle = left + 0.5 * side * patch.columns;
  angle = middle + std::remainder(angle - middle, 2.0 * kPi);
  within(angle, patch.foot.half_angle, left - kYield * side, left + (patch.columns + kYield) * side);
  patch.foot.angle = angle;
  const auto row = static_cast<std::size_t>(patch.row),
             end = static_cast<std::size_t>(patch.row + patch.rows);
  const double below = row > 0 ? kYield * (grid.arcs_m[row] - grid.arcs_m[row - 1]) : 0.0;
  const double above =
      end + 1 < grid.arcs_m.size() ? kYield * (grid.arcs_m[end + 1] - grid.arcs_m[end]) : 0.0;
  within(patch.foot.arc_m, patch.foot.half_arc_m, grid.arcs_m[row] - below, grid.arcs_m[end] + above);
}

Rim rimOf(const Patch& patch) {
  Rim rim;
  const int m = patch.rows, k = patch.columns, count = 2 * (m + k);
  std::vector<std::pair<int, int>> around;  // (row, column) in the patch, from its far right corner on
  around.reserve(static_cast<std::size_t>(count));
  rim.corners.reserve(around.capacity());
  rim.turns.reserve(around.capacity());
  for (int c = k; c > 0; --c) around.emplace_back(m, c);
  for (int r = m; r > 0; --r) around.emplace_back(r, 0);
  for (int c = 0; c < k; ++c) around.emplace_back(0, c);
  for (int r = 0; r < m; ++r) around.emplace_back(r, k);
  // The far side's middle lies half way along the first k steps.
  const int first = (k + 1) / 2;
  for (int i = 0; i < count; ++i) {
    const auto [r, c] = around[static_cast<std::size_t>((first + i) % count)];
    const double x = -1.0 + 2.0 * c / k, y = -1.0 + 2.0 * r / m;
    const double turn = std::atan2(-x, y);
    rim.corners.emplace_back(patch.row + r, patch.column + c);
    rim.turns.push_back(turn < -1e-9 ? turn + 2.0 * kPi : std::max(turn, 0.0));
  }
  return rim;
}

/// Which rings a limb's shape needs whole: between them it is straight, as far as its stations say. The first
/// and the last among them.
std::vector<bool> neededWhole(const Limb& limb, const std::vector<double>& arcs) {
  constexpr double kOffStraight = 0.1;  // of what lines may be off
  constexpr double kThicker = 0.02;     // of radii
  const auto straight = [&](double low, double high) {
    const TubeStation from = stationOn(limb, low), to = stationOn(limb, high);
    const auto fits = [&](const TubeStation& station, double arc) {
      const TubeStation wanted = mixed(from, to, (arc - low) / (high - low));
      return glm::distance(station.centre_m, wanted.centre_m) < kOffStraight * limb.off_m &&
             std::abs(station.radius_m - wanted.radius_m) < kThicker * station.radius_m;
    };
    const auto first = std::upper_bound(limb.arcs_m.begin(), limb.arcs_m.end(), low);
    for (auto arc = first; arc != limb.arcs_m.end() && *arc < high; ++arc)
      if (!fits(limb.line[static_cast<std::size_t>(arc - limb.arcs_m.begin())], *arc)) return false;
    return true;
  };
  std::vector<bool> whole(arcs.size(), false);
  whole.front() = whole.back() = true;
  for (std::size_t r = 1, last = 0; r + 1 < arcs.size(); ++r) {
    if (straight(arcs[last], arcs[r + 1])) continue;
    whole[r] = true;
    last = r;
  }
  return whole;
}

void leaveOutBesideRims(LimbGrid& grid, const Limb& limb) {
  if (grid.patches.empty()) return;
  const std::vector<bool> whole = neededWhole(limb, grid.arcs_m);
  const auto inside = static_cast<std::ptrdiff_t>(grid.absent.size());
  auto rim = grid.rim.begin();
  for (std::size_t r = 0; r < whole.size(); ++r) {
    if (whole[r]) continue;
    for (int c = 0; c < grid.sides; ++c) {
      const std::uint32_t corner = grid.corner(static_cast<int>(r), c);
      while (rim != grid.rim.end() && rim->corner < corner) ++rim;
      if (rim != grid.rim.end() && rim->corner == corner) continue;
      if (!std::binary_search(grid.absent.begin(), grid.absent.begin() + inside, corner))
        grid.absent.push_back(corner);
    }
  }
  grid.left_out = grid.absent.size() - static_cast<std::size_t>(inside);
  std::inplace_merge(grid.absent.begin(), grid.absent.begin() + inside, grid.absent.end());
}

}  // namespace

Vec3 onRim(const Limb& host, const Foot& foot, double turn) {
  const glm::dvec2 circle = sim::unitCircle(turn / (2.0 * kPi));
  return sectionAt(host, foot.arc_m + foot.half_arc_m * circle.x)
      .surface(foot.angle - foot.half_angle * circle.y);
}

LimbGrid gridOf(const Limb& limb, std::span<const Foot> standing, double error_m) {
  LimbGrid grid;
  grid.sides = limb.sides;
  std::vector<Foot> feet(standing.begin(), standing.end());
  part(feet);
  grid.arcs_m = ringArcs(limb, feet, error_m);
  const bool fine = limb.line.front().radius_m > kFine * error_m;
  const int most_sides = fine ? std::min(kMostSides, 4 * limb.sides) : limb.sides;
  std::optional<std::size_t> elsewhere;
  while (!(elsewhere = place(grid, feet))) {
    if (2 * grid.sides <= most_sides) {
      grid.sides *= 2;
    } else {
      refine(grid.arcs_m);
    }
  }
  for (LimbGrid finer = grid; *elsewhere > 0 && 2 * finer.sides <= most_sides;) {
    finer.sides *= 2;
    const std::optional<std::size_t> then = place(finer, feet);
    if (!then || *then >= *elsewhere) continue;
    elsewhere = then;
    grid = finer;
  }

  const double side = 2.0 * kPi / grid.sides;
  std::vector<RimPoint> wishes;
  grid.rims.reserve(grid.patches.size());
  for (Patch& patch : grid.patches) {
    fit(patch, grid);
    for (int r = 1; r < patch.rows; ++r) {
      for (int c = 1; c < patch.columns; ++c)
        grid.absent.push_back(grid.corner(patch.row + r, patch.column + c));
    }
    const Rim& rim = grid.rims.emplace_back(rimOf(patch));
    for (std::size_t k = 0; k < rim.corners.size(); ++k) {
      const auto [ring, column] = rim.corners[k];
      const glm::dvec2 turn = sim::unitCircle(rim.turns[k] / (2.0 * kPi));
      // In the terms of the corner's own column, which may lie a turn below the patch's.
      const double own = side * wrapped(column, grid.sides);
      const double away = std::remainder(patch.foot.angle - patch.foot.half_angle * turn.y - own, 2.0 * kPi);
      wishes.push_back(
          {grid.corner(ring, column), patch.foot.arc_m + patch.foot.half_arc_m * turn.x, own + away, {}});
    }
  }
  std::sort(grid.absent.begin(), grid.absent.end());
  std::stable_sort(wishes.begin(), wishes.end(),
                   [](const RimPoint& a, const RimPoint& b) { return a.corner < b.corner; });
  // Where rims meet, their corners lie half way between what they wish for.
  for (std::size_t k = 0, end = 0; k < wishes.size(); k = end) {
    RimPoint point{wishes[k].corner};
    for (end = k; end < wishes.size() && wishes[end].corner == point.corner; ++end) {
      point.arc_m += wishes[end].arc_m;
      point.angle += wishes[end].angle;
    }
    point.arc_m /= static_cast<double>(end - k);
    point.angle /= static_cast<double>(end - k);
    point.at_m = sectionAt(limb, point.arc_m).surface(point.angle);
    grid.rim.push_back(point);
  }
  leaveOutBesideRims(grid, limb);
  return grid;
}

std::uint32_t LimbGrid::pointOf(std::uint32_t corner) const {
  return corner -
         static_cast<std::uint32_t>(std::lower_bound(absent.begin(), absent.end(), corner) - absent.begin());
}

const RimPoint& LimbGrid::rimPoint(std::uint32_t corner) const {
  return *std::lower_bound(rim.begin(), rim.end(), corner,
                           [](const RimPoint& point, std::uint32_t wanted) { return point.corner < wanted; });
}

}  // namespace espalier::render
