#include "scenes/inspect/looks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "scenes/import/placing.h"

namespace espalier::scenes {
namespace {

/// What speaks for an axis.
struct Evidence {
  double weight = 0.0;
  std::vector<std::string> words;

  void add(double more, std::string word) {
    constexpr double kWorthAWord = 0.3;
    weight += more;
    if (more >= kWorthAWord) words.push_back(std::move(word));
  }
};

/// Weights are from the meshes that come with the program and some of strangers.
Evidence evidenceFor(int axis, int other, const MeshShape& shape) {
  constexpr double kNear = 0.06;  // of a side
  const char* const names[] = {"x", "y", "z"};
  const auto of = [](int a) { return static_cast<std::size_t>(a); };
  const sim::Vec3 size = shape.size();
  Evidence found;
  if (!(size[axis] > 0.0) || !(size[other] > 0.0)) {  // a floor
    if (size[other] > 0.0) found.add(3.0, fmt::format("it is flat across {}", names[axis]));
    return found;
  }
  const bool begins = std::abs(shape.low[axis]) <= kNear * size[axis];
  const bool astride = shape.low[other] < -kNear * size[other] && shape.high[other] > kNear * size[other];
  if (begins && astride) {
    found.add(2.0,
              fmt::format("it begins at {} = 0 and lies on both sides of {} = 0", names[axis], names[other]));
  } else if (shape.low[axis] > 0.0 && astride) {
    found.add(1.0, fmt::format("all of it has {0} > 0, and it lies on both sides of {1} = 0", names[axis],
                               names[other]));
  }
  const double net = std::abs(shape.net[axis]);
  if (net > 0.015 && net > 3.0 * std::abs(shape.net[other]))
    found.add(net > 0.5 ? 3.0 : 1.5,
              fmt::format("it has more surface on one side along {}, as what has no underside", names[axis]));
  const double below = 0.5 - (shape.middle[axis] - shape.low[axis]) / size[axis];
  if (below > 0.05)
    found.add(std::min(1.0, 4.0 * below), fmt::format("most of it is low along {}", names[axis]));
  const double least_across = std::min(size[(axis + 1) % 3], size[(axis + 2) % 3]);
  // One wall alone, or a floor, has faces that stand along two axes.
  const double walls = (shape.beside[of(axis)] - shape.beside[of(other)]) * (1.0 - shape.across[of(other)]);
  if (size[axis] < 0.2 * least_across && shape.level[of(axis)] > 0.7) {
    found.add(1.5, fmt::format("it is flat across {}", names[axis]));
  } else if (walls > 0.0) {
    found.add(walls, fmt::format("its walls stand along {}", names[axis]));
  }
  return found;
}

}  // namespace

UpLooks upOf(const MeshShape& shape, bool defined) {
  constexpr double kSure = 0.75, kDefined = 1.2;
  Evidence y = evidenceFor(1, 2, shape), z = evidenceFor(2, 1, shape);
  if (defined) y.add(kDefined, "glTF says so");
  const double more = z.weight - y.weight;
  if (std::abs(more) < kSure) return {UpAxis::y, false, "nothing tells; y is what the program takes it for"};
  const Evidence& known = more > 0.0 ? z : y;
  return {more > 0.0 ? UpAxis::z : UpAxis::y, true, fmt::format("{}", fmt::join(known.words, "; "))};
}

UnitLooks unitOf(const MeshShape& shape, UpAxis up, bool defined) {
  const double longest = shape.longest();
  const auto as = [](double metres, LengthUnit unit) {
    return fmt::format("{} m in {}", inDigits(metres), nameOf(unit));
  };
  if (longest < kLarge_m) {
    return {LengthUnit::m, defined ? std::string("glTF is in metres")
                                   : fmt::format("it is {} m long then, which may be", inDigits(longest))};
  }
  std::string readings = "its longest side is " + as(longest, LengthUnit::m);
  std::optional<LengthUnit> likeliest;
  for (const UnitReading& reading : likelyUnits(longest)) {
    if (reading.unit == LengthUnit::m) continue;
    if (!likeliest) likeliest = reading.unit;
    readings += ", " + as(reading.longest_m, reading.unit);
  }
  readings += ", " + as(Placing({.unit = LengthUnit::in}).length(longest), LengthUnit::in);
  if (likeliest && isTooHighForAHouse(shape, up))
    return {*likeliest, readings + "; nothing with walls is so high"};
  return {LengthUnit::m, readings + "; towns and terrain are so large"};
}

}  // namespace espalier::scenes
