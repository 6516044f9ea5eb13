#include "sim/light/sky_shares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "sim/base/random.h"
#include "sim/world/field.h"

namespace espalier::sim {
namespace {

using Moments = std::array<double, 5>;

Moments momentsOf(Vec3 d) {
  return {1.0, d.x, d.y, d.z, d.y * d.y};
}

/// A convex polygon in the plane that touches the sphere at `pole`: great circles are straight lines there.
struct TangentPolygon {
  explicit TangentPolygon(Vec3 p) : pole(p), across(perpendicular(p)), along(glm::cross(p, across)) {
    constexpr double kNearlyLevel = 100.0;  // as good as the pole's own horizon
    for (const auto& [s, t] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
      corners.push_back(pole + kNearlyLevel * (s * across + t * along));
  }

  /// Keeps what lies on the side to which `normal` points of the great circle perpendicular to it.
  void clip(Vec3 normal) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3 a = corners[i], b = corners[(i + 1) % corners.size()];
      const double da = glm::dot(a, normal), db = glm::dot(b, normal);
      if (da >= 0.0) kept.push_back(a);
      if ((da >= 0.0) != (db >= 0.0)) kept.push_back(a + da / (da - db) * (b - a));
    }
    corners = std::move(kept);
  }

  /// A. van Oosterom and J. Strackee, "The Solid Angle of a Plane Triangle", IEEE Trans. Biomed. Eng. 1983.
  double solidAngle() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3 a = glm::normalize(corners[i]), b = glm::normalize(corners[(i + 1) % corners.size()]);
      sum += 2.0 * std::atan2(glm::dot(pole, glm::cross(a, b)),
                              1.0 + glm::dot(pole, a) + glm::dot(a, b) + glm::dot(b, pole));
    }
    return sum;
  }

  Vec3 pole, across, along;
  std::vector<Vec3> corners;
};

/// Solves a symmetric system; false if it has no clear answer.
bool solve(std::array<Moments, 5> a, Moments b, Moments& x) {
  for (std::size_t k = 0; k < 5; ++k) {
    std::size_t pivot = k;
    for (std::size_t r = k; r < 5; ++r) {
      if (std::abs(a[r][k]) > std::abs(a[pivot][k])) pivot = r;
    }
    if (std::abs(a[pivot][k]) < 1e-9) return false;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t r = k + 1; r < 5; ++r) {
      const double factor = a[r][k] / a[k][k];
      for (std::size_t c = k; c < 5; ++c) a[r][c] -= factor * a[k][c];
      b[r] -= factor * b[k];
    }
  }
  for (std::size_t k = 5; k-- > 0;) {
    x[k] = b[k];
    for (std::size_t c = k + 1; c < 5; ++c) x[k] -= a[k][c] * x[c];
    x[k] /= a[k][k];
  }
  return true;
}

double dot(const Moments& a, const Moments& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

Moments plus(Moments a, double factor, const Moments& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += factor * b[k];
  return a;
}

}  // namespace

std::vector<double> voronoiShares(const std::vector<Vec3>& units) {
  const double spacing = std::sqrt(2.0 * std::numbers::pi / static_cast<double>(units.size()));
  // A cell reaches less than one and a half spacings, so its neighbours lie within three.
  const double nearest_cosine = 3.0 * spacing < std::numbers::pi ? 1.0 - 4.5 * spacing * spacing : -2.0;
  std::vector<double> shares;
  std::vector<std::pair<double, std::size_t>> near;
  for (const Vec3& p : units) {
    near.clear();
    for (std::size_t i = 0; i < units.size(); ++i) {
      const double cosine = glm::dot(p, units[i]);
      if (cosine > nearest_cosine && units[i] != p) near.emplace_back(-cosine, i);
    }
    std::sort(near.begin(), near.end());
    TangentPolygon cell(p);
    cell.clip(Vec3(0, 1, 0));
    for (const auto& [_, i] : near) cell.clip(p - units[i]);
    shares.push_back(cell.solidAngle());
  }
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= sum;
  return shares;
}

void meetMoments(const std::vector<Vec3>& units, std::vector<double>& shares) {
  // The least change, measured in proportion to the shares, is share * (f . lambda).
  std::array<Moments, 5> system{};
  Moments missing{1.0, 0.0, 0.5, 0.0, 1.0 / 3.0};
  for (std::size_t i = 0; i < units.size(); ++i) {
    const Moments f = momentsOf(units[i]);
    missing = plus(missing, -shares[i], f);
    for (std::size_t r = 0; r < 5; ++r) system[r] = plus(system[r], shares[i] * f[r], f);
  }
  Moments lambda{};
  if (!solve(system, missing, lambda)) return;
  std::vector<double> changed;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const double factor = 1.0 + dot(lambda, momentsOf(units[i]));
    if (factor < 0.0) return;
    changed.push_back(shares[i] * factor);
  }
  shares = std::move(changed);
}

std::vector<std::uint16_t> wholeShares(const std::vector<Vec3>& units, const std::vector<double>& shares) {
  std::vector<std::uint16_t> whole;
  std::vector<Moments> moments;
  std::vector<bool> raised;
  Moments error{};
  for (std::size_t i = 0; i < units.size(); ++i) {
    const double exact = shares[i] * ExposureField::kWhole;
    whole.push_back(static_cast<std::uint16_t>(exact));
    moments.push_back(momentsOf(units[i]));
    const Moments down = plus(error, whole.back() - exact, moments[i]), up = plus(down, 1.0, moments[i]);
    raised.push_back(dot(up, up) < dot(down, down));
    error = raised.back() ? up : down;
  }
  // The count must be met: by single steps. Then exchanges mend the other sums.
  const auto flip = [&](std::size_t i) { return plus(error, raised[i] ? -1.0 : 1.0, moments[i]); };
  while (std::abs(error[0]) > 0.5) {
    const bool too_many = error[0] > 0.0;
    std::size_t best = units.size();
    for (std::size_t i = 0; i < units.size(); ++i) {
      if (raised[i] != too_many) continue;
      if (best == units.size() || dot(flip(i), flip(i)) < dot(flip(best), flip(best))) best = i;
    }
    error = flip(best);
    raised[best] = !raised[best];
  }
  constexpr int kExchanges = 8;
  constexpr std::size_t kPartners = 64;  // enough choice, and not all of a large set
  constexpr double kGood = 0.3;          // units of a weight
  for (int k = 0; k < kExchanges && dot(error, error) > kGood * kGood; ++k) {
    double least = dot(error, error);
    std::pair<std::size_t, std::size_t> best{0, 0};
    for (std::size_t i = 0; i < units.size(); ++i) {
      const Moments one = flip(i);
      for (std::size_t j = i + 1; j < std::min(units.size(), i + kPartners); ++j) {
        if (raised[i] == raised[j]) continue;
        const Moments both = plus(one, raised[j] ? -1.0 : 1.0, moments[j]);
        if (dot(both, both) < least) {
          least = dot(both, both);
          best = {i, j};
        }
      }
    }
    if (best.first == best.second) break;
    for (const std::size_t i : {best.first, best.second}) {
      error = flip(i);
      raised[i] = !raised[i];
    }
  }
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (raised[i]) ++whole[i];
  }
  return whole;
}

}  // namespace espalier::sim
