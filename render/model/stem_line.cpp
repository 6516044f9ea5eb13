#include "render/model/stem_line.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace espalier::render {

using sim::Vec3;

namespace {

constexpr int kSamples = 24;  // of a segment
constexpr int kRounds = 4;    // each halves the way between knots

}  // namespace

StemLine::StemLine(std::span<const Vec3> points, std::optional<Vec3> start_derivative, const Blocked& blocked)
    : points_(points.begin(), points.end()) {
  std::vector<int> pieces(points.size() - 1, 1);
  for (int round = 0;; ++round) {
    std::vector<Vec3> through{points[0]};
    std::vector<double> knots{0.0};
    knots_.assign(1, 0.0);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const double time = std::sqrt(glm::distance(points[i], points[i + 1]) / pieces[i]);
      for (int k = 1; k <= pieces[i]; ++k) {
        through.push_back(glm::mix(points[i], points[i + 1], static_cast<double>(k) / pieces[i]));
        knots.push_back(knots.back() + time);
      }
      knots_.push_back(knots.back());
    }
    const auto start = start_derivative ? std::optional(*start_derivative / knots_[1]) : std::nullopt;
    spline_ = Spline(through, std::move(knots), start);
    if (!blocked) return;
    std::vector<bool> entering(pieces.size(), false);
    bool any = false;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      entering[i] = enters(i, blocked);
      any = any || entering[i];
    }
    if (!any) return;
    if (round == kRounds) {
      straight_ = entering;
      return;
    }
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (entering[i]) pieces[i] *= 2;
    // The more alike pieces are beside each other, the less it swings out.
    for (std::size_t i = 1; i < pieces.size(); ++i) pieces[i] = std::max(pieces[i], pieces[i - 1] / 2);
    for (std::size_t i = pieces.size() - 1; i > 0; --i)
      pieces[i - 1] = std::max(pieces[i - 1], pieces[i] / 2);
  }
}

StemLine::Place StemLine::placeAt(double t) const {
  const double segment = std::clamp(std::floor(t), 0.0, last() - 1.0);
  return {static_cast<std::size_t>(segment), t - segment};
}

bool StemLine::enters(std::size_t segment, const Blocked& blocked) const {
  for (int k = 1; k < kSamples; ++k) {
    const double share = static_cast<double>(k) / kSamples;
    if (blocked(position(static_cast<double>(segment) + share)) &&
        !blocked(glm::mix(points_[segment], points_[segment + 1], share)))
      return true;
  }
  return false;
}

Vec3 StemLine::position(double t) const {
  const auto [i, share] = placeAt(t);
  if (!straight_.empty() && straight_[i]) return glm::mix(points_[i], points_[i + 1], share);
  return spline_.position(knots_[i] + share * (knots_[i + 1] - knots_[i]));
}

Vec3 StemLine::derivative(double t) const {
  const auto [i, share] = placeAt(t);
  if (!straight_.empty() && straight_[i]) return points_[i + 1] - points_[i];
  const double knots = knots_[i + 1] - knots_[i];
  return knots * spline_.derivative(knots_[i] + share * knots);
}

}  // namespace espalier::render
