#include "render/form/forks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "render/form/one_by_one.h"
#include "render/form/reshaped.h"
#include "render/form/stretch.h"
#include "render/model/radii.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"

namespace espalier::render {
namespace {

using sim::NodeId;
using sim::Vec3;

constexpr double kSamePlace = 1e-6;  // voxel widths
// Shares of a stretch that are straight, at most: behind the fork in which it starts, before the one in which
// it ends, and of one to a tip.
constexpr double kMostAtStart = 0.65, kMostAtEnd = 0.2, kMostToTip = 0.8;

Vec3 unitOr(Vec3 v, Vec3 otherwise) {
  const double length = glm::length(v);
  return length > kSamePlace ? v / length : otherwise;
}

/// Square to a unit vector.
Vec3 aside(Vec3 unit) {
  const Vec3 axis = std::abs(unit.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
  return glm::normalize(glm::cross(unit, axis));
}

Vec3 across(Vec3 v, Vec3 unit) {
  return v - glm::dot(v, unit) * unit;
}

double angleCosine(double r0, double r1, double r2) {
  const double a = r0 * r0, b = r1 * r1, c = r2 * r2;
  return std::clamp((a * a + b * b - c * c) / (2.0 * a * b), -1.0, 1.0);
}

/// How a stretch begins and ends.
struct Ends {
  Vec3 start{0.0}, end{0.0};                        // unit ways; at the end, the one in which it comes there
  double straight_start = 0.0, straight_end = 0.0;  // voxel widths; 0: as it grew
};

/// The stretches of a plant on whose forks two daughters leave, and the ends that they shall have.
struct Plan {
  std::vector<Stretch> stretches;
  std::vector<Ends> ends;
};

/// A unit vector, turned about another by an angle, radians; square to it.
Vec3 turned(Vec3 v, Vec3 about, double angle) {
  return std::cos(angle) * v + std::sin(angle) * glm::cross(about, v);
}

/// The ways in which a fork's daughters leave it.
struct Fork {
  Vec3 in{0.0}, first{0.0}, second{0.0};  // unit
};

/// In the plane in which it grew, or else in the next one to that in which its straight pieces have room.
Fork forkAt(const Stretch& in, const Stretch& first, const Stretch& second, ForkAngles angles,
            double straight, double first_weight, double second_weight, const KeptFree& blocked) {
  constexpr int kPlanes = 16;
  const Vec3 fork = in.at(in.length());
  const double look = 2.0 * straight;
  const Vec3 came = unitOr(fork - in.at(in.length() - look), Vec3(0, 1, 0));
  const Vec3 to_first = unitOr(first.at(look) - fork, came), to_second = unitOr(second.at(look) - fork, came);
  // The way there is a compromise of where it comes from and where its daughters go, each as strong as it is
  // wide.
  const Vec3 pulled = unitOr(first_weight * to_first + second_weight * to_second, came);
  const Vec3 way = unitOr(came + pulled, came);
  std::optional<Fork> grown;
  for (const Vec3 along : {way, came}) {
    const Vec3 side = unitOr(across(to_second - to_first, along), aside(along));
    for (int k = 0; k < kPlanes; ++k) {
      const double turn = (k % 2 == 0 ? 1 : -1) * ((k + 1) / 2) * 2.0 * std::numbers::pi / kPlanes;
      const Vec3 out = turned(side, along, turn);
      const Fork tried{along, std::cos(angles.first) * along - std::sin(angles.first) * out,
                       std::cos(angles.second) * along + std::sin(angles.second) * out};
      if (!grown) grown = tried;
      if (!enters(fork - straight * tried.in, fork, blocked) &&
          !enters(fork, fork + straight * tried.first, blocked) &&
          !enters(fork, fork + straight * tried.second, blocked))
        return tried;
    }
  }
  return *grown;
}

Plan planOf(const sim::Plant& plant, const KeptFree& blocked) {
  Plan plan;
  plan.stretches = stretchesOf(plant.skeleton);
  plan.ends.resize(plan.stretches.size());
  const std::vector<float> radii = stemRadii(plant.skeleton, plant.girth);
  const auto radius = [&](const Stretch& s) {
    return static_cast<double>(radii[static_cast<std::size_t>(s.nodes.back())]);
  };
  std::vector<std::vector<std::size_t>> leaving(static_cast<std::size_t>(plant.skeleton.size()));
  for (std::size_t i = 0; i < plan.stretches.size(); ++i)
    leaving[static_cast<std::size_t>(plan.stretches[i].from)].push_back(i);
  sim::parallelForEach(plan.stretches.size(), [&](std::size_t i) {
    const Stretch& in = plan.stretches[i];
    const auto& out = leaving[static_cast<std::size_t>(in.nodes.back())];
    if (out.size() != 2 || in.length() <= kSamePlace) return;
    const Stretch &first = plan.stretches[out[0]], &second = plan.stretches[out[1]];
    if (first.length() <= kSamePlace || second.length() <= kSamePlace) return;
    const double r0 = radius(in), r1 = radius(first), r2 = radius(second);
    const double straight = kStraightRadii * r0;
    const Fork fork =
        forkAt(in, first, second, murrayAngles(r0, r1, r2), straight, r1 * r1, r2 * r2, blocked);
    plan.ends[i].end = fork.in;
    plan.ends[i].straight_end = std::min(straight, kMostAtEnd * in.length());
    const auto leave = [&](std::size_t one, Vec3 way) {
      const double length = plan.stretches[one].length();
      const bool to_tip = leaving[static_cast<std::size_t>(plan.stretches[one].nodes.back())].empty();
      // A twig that hardly leaves what it grows from is turned whole.
      const double most = !to_tip                           ? kMostAtStart * length
                          : kMostToTip * length >= straight ? straight
                                                            : length;
      plan.ends[one].start = way;
      plan.ends[one].straight_start = std::min(straight, most);
    };
    leave(out[0], fork.first);
    leave(out[1], fork.second);
  });
  return plan;
}

Vec3 hermite(Vec3 a, Vec3 a_way, Vec3 b, Vec3 b_way, double width, double t) {
  const double u = 1.0 - t;
  return u * u * (1.0 + 2.0 * t) * a + t * t * (3.0 - 2.0 * t) * b + width * t * u * (u * a_way - t * b_way);
}

/// How much of what is planned is tried: shares of the straight ends, and how far, in these, it bends back.
struct Attempt {
  double start, end, blend;
};
constexpr std::array kAttempts{Attempt{1, 1, 2.5}, Attempt{1, 1, 1.5},     Attempt{1, 0.5, 1.5},
                               Attempt{1, 0, 2.5}, Attempt{1, 0, 1.2},     Attempt{0.5, 1, 2.0},
                               Attempt{0, 1, 2.0}, Attempt{0.5, 0.5, 2.0}, Attempt{0.25, 0.25, 2.0}};

/// A stretch with ends of its own.
class Turned {
 public:
  Turned(const Stretch& stretch, const Ends& ends, const Attempt& attempt) : s_(stretch), ends_(ends) {
    const double length = s_.length();
    start_ = attempt.start * ends.straight_start;
    end_ = length - attempt.end * ends.straight_end;
    const double middle = 0.5 * (start_ + end_);
    blend_start_ = start_ > 0.0 ? std::min(end_ < length ? middle : length, attempt.blend * start_) : 0.0;
    blend_end_ = end_ < length ? std::max(middle, length - attempt.blend * (length - end_)) : length;
  }

  /// Where it is so far along as it was: as far as it grew.
  Vec3 at(double arc) const {
    const double length = s_.length();
    if (start_ > 0.0 && (arc <= start_ || arc < blend_start_)) {
      const Vec3 fork = s_.at(0.0);
      if (arc <= start_) return fork + arc * ends_.start;
      const double width = blend_start_ - start_;
      return hermite(fork + start_ * ends_.start, ends_.start, s_.at(blend_start_), wayAt(blend_start_),
                     width, (arc - start_) / width);
    }
    if (end_ < length && arc > blend_end_) {
      const Vec3 fork = s_.at(length);
      if (arc >= end_) return fork - (length - arc) * ends_.end;
      const double width = end_ - blend_end_;
      return hermite(s_.at(blend_end_), wayAt(blend_end_), fork - (length - end_) * ends_.end, ends_.end,
                     width, (arc - blend_end_) / width);
    }
    return s_.at(arc);
  }

  /// Where it needs points, besides the nodes.
  std::vector<double> arcs() const {
    constexpr int kStraightPoints = 3, kBentPoints = 5;
    std::vector<double> arcs;
    const auto spread = [&](double from, double to, int count) {
      for (int k = 1; k <= count; ++k) arcs.push_back(from + (to - from) * k / count);
    };
    if (start_ > 0.0) {
      spread(0.0, start_, kStraightPoints);
      spread(start_, blend_start_, kBentPoints);
    }
    if (end_ < s_.length()) {
      spread(s_.length(), end_, kStraightPoints);
      spread(end_, blend_end_, kBentPoints);
      std::sort(arcs.begin(), arcs.end());
    }
    return arcs;
  }

 private:
  Vec3 wayAt(double arc) const {
    const double about = 0.25 * std::max(start_, s_.length() - end_);
    return unitOr(s_.at(arc + about) - s_.at(arc - about), Vec3(0, 1, 0));
  }

  const Stretch& s_;
  const Ends& ends_;
  double start_ = 0.0, end_ = 0.0, blend_start_ = 0.0, blend_end_ = 0.0;
};

/// The ways of a stretch's nodes on a turned one.
std::vector<Reshaped> waysOn(const Stretch& stretch, const Turned& turned) {
  const std::vector<double> arcs = turned.arcs();
  std::vector<Reshaped> ways(stretch.nodes.size());
  auto next = arcs.begin();
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const double begin = stretch.arcs[k], end = stretch.arcs[k + 1];
    const double least = 1e-3 * (end - begin);  // two points nearer than that are one
    double last = begin;
    for (; next != arcs.end() && *next < end; ++next) {
      if (*next - last <= least || end - *next <= least) continue;
      ways[k].through.push_back(turned.at(*next));
      ways[k].shares.push_back((*next - begin) / (end - begin));
      last = *next;
    }
    ways[k].through.push_back(turned.at(end));
    ways[k].shares.push_back(1.0);
  }
  return ways;
}

bool anyEnters(Vec3 start, const std::vector<Reshaped>& ways, const KeptFree& blocked) {
  for (const Reshaped& way : ways) {
    for (const Vec3 place : way.through) {
      if (enters(start, place, blocked)) return true;
      start = place;
    }
  }
  return false;
}

}  // namespace

ForkAngles murrayAngles(double r0, double r1, double r2) {
  return {std::acos(angleCosine(r0, r1, r2)), std::acos(angleCosine(r0, r2, r1))};
}

sim::Plant withMurrayForks(const sim::Plant& grown, const KeptFree& blocked) {
  const sim::Plant plant = leavingOneByOne(grown, blocked);
  const Plan plan = planOf(plant, blocked);
  std::vector<Reshaped> ways = asGrown(plant.skeleton);
  sim::parallelForEach(plan.stretches.size(), [&](std::size_t i) {
    sim::throwIfStopped();
    const Stretch& stretch = plan.stretches[i];
    for (const Attempt& attempt : kAttempts) {
      std::vector<Reshaped> turned = waysOn(stretch, Turned(stretch, plan.ends[i], attempt));
      if (anyEnters(stretch.points.front(), turned, blocked)) continue;
      for (std::size_t k = 0; k < turned.size(); ++k)
        ways[static_cast<std::size_t>(stretch.nodes[k])] = std::move(turned[k]);
      return;
    }
  });
  return reshaped(plant, ways);
}

}  // namespace espalier::render
