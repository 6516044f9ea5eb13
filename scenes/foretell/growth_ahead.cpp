#include "scenes/foretell/growth_ahead.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "sim/base/frame.h"
#include "sim/world/band.h"

namespace espalier::scenes {
namespace {

constexpr double kDamping = 0.95;  // of the trend's slope, from iteration to iteration
constexpr double kSlowing = 0.85;  // of growth in a brick that is older than any is yet
constexpr std::int32_t kNever = -1;
constexpr int kBrick_vx = 8;  // as sim::Bricks has them

sim::Voxel brickOf(sim::Vec3 at_vx) {
  return sim::voxelAt(at_vx) / kBrick_vx;
}

template <class Visit>
void forEachNode(std::span<const sim::Plant> plants, Visit visit) {
  for (const sim::Plant& plant : plants) {
    const sim::Skeleton& s = plant.skeleton;
    for (std::size_t i = 0; i < s.parent.size(); ++i)
      visit(brickOf(s.position_vx[i]), s.born[i], s.parent[i] == sim::kNoNode);
  }
}

/// When plants came into each brick.
struct Taken {
  sim::Voxel size;
  std::vector<std::int32_t> since;
  std::vector<sim::Voxel> bricks{};

  std::int32_t& at(sim::Voxel b) {
    return since[(static_cast<std::size_t>(b.y) * static_cast<std::size_t>(size.z) +
                  static_cast<std::size_t>(b.z)) *
                     static_cast<std::size_t>(size.x) +
                 static_cast<std::size_t>(b.x)];
  }
};

Taken takenBy(std::span<const sim::Plant> plants, sim::Voxel size) {
  Taken taken{size,
              std::vector<std::int32_t>(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                                            static_cast<std::size_t>(size.z),
                                        kNever)};
  forEachNode(plants, [&](sim::Voxel brick, std::int32_t born, bool) {
    std::int32_t& since = taken.at(brick);
    if (since == kNever) taken.bricks.push_back(brick);
    since = since == kNever ? born : std::min(since, born);
  });
  return taken;
}

/// How many bricks more plants can come into.
double freeBricks(const Taken& taken, const sim::BitVolume& near) {
  constexpr double kMostOutside = 0.1;
  const auto outside = static_cast<double>(
      std::count_if(taken.bricks.begin(), taken.bricks.end(), [&](sim::Voxel b) { return !near.at(b); }));
  const auto count = static_cast<double>(taken.bricks.size());
  if (outside > kMostOutside * count) return static_cast<double>(taken.since.size()) - count;
  sim::BitVolume reached(near.size());
  for (const sim::Voxel brick : taken.bricks) reached.set(brick);
  std::vector<sim::Voxel> front = taken.bricks;
  double free = 0.0;
  while (!front.empty()) {
    const sim::Voxel from = front.back();
    front.pop_back();
    for (int i = 0; i < 27; ++i) {
      const sim::Voxel to = from + sim::Voxel(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (!sim::contains(near.size(), to) || !near.at(to) || reached.at(to)) continue;
      reached.set(to);
      front.push_back(to);
      ++free;
    }
  }
  return free;
}

struct Line {
  double last = 0.0, slope = 0.0;
};

/// The line of least squares.
Line through(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n, middle = 0.5 * (n - 1.0);
  double both = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = static_cast<double>(i) - middle;
    both += x * (values[i] - mean);
    squares += x * x;
  }
  const double slope = squares > 0.0 ? both / squares : 0.0;
  return {mean + slope * middle, slope};
}

/// Goes on with how many bricks are newly taken in each iteration.
void goOn(std::vector<double>& taken, double free, int more) {
  constexpr std::size_t kLeast = 4;  // that the trend is seen in, where there are so many
  const std::span<const double> known = std::span<const double>(taken).subspan(1);  // without the seeds
  if (known.empty()) return taken.resize(taken.size() + static_cast<std::size_t>(more), 0.0);
  const std::size_t late = std::min(known.size(), std::max(kLeast, known.size() * 3 / 5));
  const Line line = through(known.last(late));
  double value = std::max(0.0, line.last), step = line.slope;
  for (int i = 0; i < more; ++i) {
    step *= kDamping;
    value = std::clamp(value + step, 0.0, free);
    free -= value;
    taken.push_back(value);
  }
}

/// How many segments a brick gains at each age, on average, as far as there are bricks so old.
std::vector<double> gains(std::span<const sim::Plant> plants, Taken& taken, std::span<const double> newly) {
  std::vector<double> gained(newly.size(), 0.0), bricks(newly.size(), 0.0);
  forEachNode(plants, [&](sim::Voxel brick, std::int32_t born, bool seed) {
    if (!seed) gained[static_cast<std::size_t>(born - taken.at(brick))] += 1.0;
  });
  double sum = 0.0;
  for (std::size_t age = newly.size(); age-- > 0;) {
    sum += newly[newly.size() - 1 - age];
    bricks[age] = sum;
  }
  // Few bricks are old: the oldest quarter of ages is taken together.
  const std::size_t few = std::min(newly.size(), std::max<std::size_t>(3, newly.size() / 4)),
                    from = newly.size() - few;
  double gained_old = 0.0, bricks_old = 0.0;
  for (std::size_t age = from; age < newly.size(); ++age) {
    gained_old += gained[age];
    bricks_old += bricks[age];
  }
  for (std::size_t age = 0; age < newly.size(); ++age) {
    const bool old = age >= from;
    const double of = old ? bricks_old : bricks[age];
    gained[age] = of > 0.0 ? (old ? gained_old : gained[age]) / of : 0.0;
  }
  return gained;
}

}  // namespace

sim::Bricks bricksNearSurfaces(const sim::World& world) {
  return sim::Bricks(sim::freeBand(world, world.occupied(), 1));
}

double segmentsAhead(std::span<const sim::Plant> plants, const sim::Bricks& near_surfaces, int iterations,
                     int more) {
  const sim::BitVolume& near = near_surfaces.bits();
  Taken taken = takenBy(plants, near.size());
  std::vector<double> newly(static_cast<std::size_t>(iterations) + 1, 0.0);
  for (const sim::Voxel brick : taken.bricks) newly[static_cast<std::size_t>(taken.at(brick))] += 1.0;
  std::vector<double> gained = gains(plants, taken, newly);
  goOn(newly, freeBricks(taken, near), more);
  for (int i = 0; i < more; ++i) gained.push_back(kSlowing * gained.back());
  double segments = 0.0;
  for (const sim::Plant& plant : plants) segments += static_cast<double>(plant.skeleton.parent.size()) - 1.0;
  // All that a brick gains until an age, so that each is asked once, however many iterations are ahead.
  std::vector<double> until{0.0};
  for (const double gain : gained) until.push_back(until.back() + gain);
  const auto known = static_cast<std::size_t>(iterations) + 1;
  for (std::size_t since = 0; since < newly.size(); ++since)
    segments += newly[since] * (until[newly.size() - since] - until[known - std::min(known, since)]);
  return segments;
}

}  // namespace espalier::scenes
