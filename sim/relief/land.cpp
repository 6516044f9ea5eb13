#include "sim/relief/land.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "sim/base/error.h"

namespace espalier::sim {
namespace {

constexpr std::int32_t kLeaf = 4;
constexpr std::size_t kDeepest = 64;  // halves of what 32 bits can number

double beyond(const Course& course, glm::dvec2 at_m, double share) {
  const glm::dvec2 foot = course.from_m + share * (course.to_m - course.from_m);
  const glm::dvec2 aside = at_m - foot;
  return std::max(0.0, std::sqrt(glm::dot(aside, aside)) - course.half_width_m);
}

}  // namespace

double shareAlong(const Course& course, glm::dvec2 at_m) {
  const glm::dvec2 way = course.to_m - course.from_m;
  const double square = glm::dot(way, way);
  return square > 0.0 ? std::clamp(glm::dot(at_m - course.from_m, way) / square, 0.0, 1.0) : 0.0;
}

double heightBy(const Course& course, const Flank& flank, glm::dvec2 at_m) {
  const double share = shareAlong(course, at_m);
  return course.from_height_m + share * (course.to_height_m - course.from_height_m) +
         flank.rise(beyond(course, at_m, share));
}

Land::Land(std::vector<Course> courses, const Flank& flank) : courses_(std::move(courses)), flank_(flank) {
  if (courses_.empty()) throw BrokenContract("land without a course");
  const auto count = static_cast<std::int32_t>(courses_.size());
  order_.resize(courses_.size());
  for (std::int32_t i = 0; i < count; ++i) order_[static_cast<std::size_t>(i)] = i;
  boxes_.reserve(courses_.size());
  boxes_.emplace_back();
  split(0, 0, count);
}

void Land::split(std::size_t box, std::int32_t first, std::int32_t count) {
  Box made;
  made.low = glm::dvec2(std::numeric_limits<double>::infinity());
  made.high = -made.low;
  made.least_m = made.low.x;
  const auto begin = order_.begin() + first, end = begin + count;
  for (auto at = begin; at != end; ++at) {
    const Course& course = courses_[static_cast<std::size_t>(*at)];
    made.low = glm::min(made.low, glm::min(course.from_m, course.to_m));
    made.high = glm::max(made.high, glm::max(course.from_m, course.to_m));
    made.least_m = std::min({made.least_m, course.from_height_m, course.to_height_m});
    made.most_half_m = std::max(made.most_half_m, course.half_width_m);
  }
  made.first = first;
  made.count = count;
  if (count > kLeaf) {
    const glm::dvec2 size = made.high - made.low;
    const int axis = size.x >= size.y ? 0 : 1;
    const std::int32_t half = count / 2;
    std::nth_element(begin, begin + half, end, [&](std::int32_t a, std::int32_t b) {
      const auto middle = [&](std::int32_t i) {
        const Course& course = courses_[static_cast<std::size_t>(i)];
        return course.from_m[axis] + course.to_m[axis];
      };
      return std::pair(middle(a), a) < std::pair(middle(b), b);
    });
    made.first = static_cast<std::int32_t>(boxes_.size());
    made.count = 0;
    boxes_.emplace_back();
    boxes_.emplace_back();
    boxes_[box] = made;
    split(static_cast<std::size_t>(made.first), first, half);
    split(static_cast<std::size_t>(made.first) + 1, first + half, count - half);
    return;
  }
  boxes_[box] = made;
}

template <class Value, class Bound>
LandAt Land::least(glm::dvec2 at_m, std::int32_t near, Value value, Bound bound) const {
  LandAt best{value(courses_[static_cast<std::size_t>(near)]), near};
  std::array<std::pair<double, std::int32_t>, 2 * kDeepest> open;
  std::size_t count = 0;
  const auto push = [&](std::int32_t box) {
    const Box& b = boxes_[static_cast<std::size_t>(box)];
    const glm::dvec2 aside = glm::max(glm::max(b.low - at_m, at_m - b.high), glm::dvec2(0.0));
    const double far = std::max(0.0, std::sqrt(glm::dot(aside, aside)) - b.most_half_m);
    // Rounding must not make a bound more than what it bounds.
    const double low = bound(b, far);
    const double least = low - 1e-9 * (1.0 + std::abs(low) + std::abs(b.least_m));
    if (least <= best.height_m) open[count++] = {least, box};
  };
  push(0);
  while (count > 0) {
    const auto [least, box] = open[--count];
    if (least > best.height_m) continue;
    const Box& b = boxes_[static_cast<std::size_t>(box)];
    if (b.count == 0) {
      const std::size_t before = count;
      push(b.first);
      push(b.first + 1);
      // The nearer one is looked into first.
      if (count == before + 2 && open[before].first < open[before + 1].first)
        std::swap(open[before], open[before + 1]);
      continue;
    }
    for (std::int32_t i = b.first; i < b.first + b.count; ++i) {
      const std::int32_t course = order_[static_cast<std::size_t>(i)];
      const double height = value(courses_[static_cast<std::size_t>(course)]);
      if (height < best.height_m || (height == best.height_m && course < best.course))
        best = {height, course};
    }
  }
  return best;
}

LandAt Land::at(glm::dvec2 at_m, std::int32_t near) const {
  return least(
      at_m, near, [&](const Course& course) { return heightBy(course, flank_, at_m); },
      [&](const Box& box, double far) { return box.least_m + flank_.rise(far); });
}

LandAt Land::distance(glm::dvec2 at_m, std::int32_t near) const {
  return least(
      at_m, near, [&](const Course& course) { return beyond(course, at_m, shareAlong(course, at_m)); },
      [](const Box&, double far) { return far; });
}

}  // namespace espalier::sim
