#include "render/model/radii.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/base/error.h"

namespace espalier::render {

namespace {

/// All tips are equally thick, so r^e = tips * tip^e: counting tips in whole numbers keeps the sums exact.
std::vector<double> byPipes(const sim::Skeleton& skeleton, const sim::StemGirth& girth) {
  std::vector<std::int64_t> tips(static_cast<std::size_t>(skeleton.size()), 0);
  std::vector<double> radii(tips.size());
  for (std::size_t n = tips.size(); n-- > 0;) {
    tips[n] = std::max<std::int64_t>(tips[n], 1);
    if (skeleton.parent[n] != sim::kNoNode) tips[static_cast<std::size_t>(skeleton.parent[n])] += tips[n];
    radii[n] = girth.twig_vx * std::pow(static_cast<double>(tips[n]), 1.0 / girth.exponent);
  }
  return radii;
}

/// A limb may be born after what it carries only in the skeletons of others; then it is as old.
std::vector<double> byAge(const sim::Skeleton& skeleton, const sim::StemGirth& girth) {
  std::vector<std::int32_t> born = skeleton.born;
  std::int32_t last = 0;
  for (std::size_t n = born.size(); n-- > 0;) {
    last = std::max(last, born[n]);
    if (skeleton.parent[n] == sim::kNoNode) continue;
    std::int32_t& below = born[static_cast<std::size_t>(skeleton.parent[n])];
    below = std::min(below, born[n]);
  }
  std::vector<double> radii;
  for (const std::int32_t iteration : born)
    radii.push_back(girth.twig_vx + girth.thickens_vx * static_cast<double>(last - iteration));
  return radii;
}

std::vector<double> asGiven(const std::vector<float>& given, const sim::StemGirth& girth) {
  std::vector<double> radii;
  for (const float radius : given)
    radii.push_back(std::isfinite(radius) && radius > 0.0f ? static_cast<double>(radius) : girth.twig_vx);
  return radii;
}

std::vector<double> uncut(const sim::Skeleton& skeleton, const sim::StemGirth& girth) {
  if (const auto* const given = sim::find(skeleton, sim::kRadiusColumn)) return asGiven(*given, girth);
  return girth.by == sim::StemGirth::By::age ? byAge(skeleton, girth) : byPipes(skeleton, girth);
}

/// Multiplies radii for each fork at which a segment's limb, or one that carries it, left another.
void makeSlender(const sim::Skeleton& skeleton, double share, std::vector<double>& radii) {
  const auto nodes = radii.size();
  if (const auto* const orders = sim::find(skeleton, "order")) {
    for (std::size_t n = 0; n < nodes; ++n)
      radii[n] *= std::pow(share, std::max(0.0, static_cast<double>((*orders)[n])));
    return;
  }
  const auto at = [&](std::size_t n) { return skeleton.position_vx[n]; };
  // How straight it goes on from its parent.
  const auto straightness = [&](std::size_t n) {
    const auto parent = static_cast<std::size_t>(skeleton.parent[n]);
    const sim::NodeId below = skeleton.parent[parent];
    const sim::Vec3 before =
        below == sim::kNoNode ? sim::Vec3(0, 1, 0) : at(parent) - at(static_cast<std::size_t>(below));
    const sim::Vec3 way = at(n) - at(parent);
    const double lengths = glm::length(before) * glm::length(way);
    return lengths > 0.0 ? glm::dot(before, way) / lengths : 1.0;
  };
  std::vector<sim::NodeId> goes_on(nodes, sim::kNoNode);
  for (std::size_t n = 0; n < nodes; ++n) {
    if (skeleton.parent[n] == sim::kNoNode) continue;
    sim::NodeId& main = goes_on[static_cast<std::size_t>(skeleton.parent[n])];
    const auto other = static_cast<std::size_t>(main);
    if (main == sim::kNoNode || radii[n] > radii[other] ||
        (radii[n] == radii[other] && straightness(n) > straightness(other)))
      main = static_cast<sim::NodeId>(n);
  }
  std::vector<double> shares(nodes, 1.0);
  for (std::size_t n = 0; n < nodes; ++n) {
    if (skeleton.parent[n] == sim::kNoNode) continue;
    const auto parent = static_cast<std::size_t>(skeleton.parent[n]);
    // All that grows from a seed is of the first order.
    const bool same =
        goes_on[parent] == static_cast<sim::NodeId>(n) || skeleton.parent[parent] == sim::kNoNode;
    shares[n] = shares[parent] * (same ? 1.0 : share);
    radii[n] *= shares[n];
  }
}

}  // namespace

std::vector<float> stemRadii(const sim::Skeleton& skeleton, const sim::StemGirth& girth) {
  if (!(girth.exponent >= 1.0 && girth.twig_vx > 0.0 && girth.most_vx > 0.0 && girth.thickens_vx >= 0.0 &&
        girth.order_share > 0.0)) {
    throw sim::InputError("the exponent of stems must be at least 1, and their radii positive");
  }
  const auto nodes = static_cast<std::size_t>(skeleton.size());
  std::vector<float> radii;
  radii.reserve(nodes);
  std::vector<double> full = uncut(skeleton, girth);
  if (girth.order_share != 1.0 && sim::find(skeleton, sim::kRadiusColumn) == nullptr)
    makeSlender(skeleton, girth.order_share, full);
  for (const double radius : full) radii.push_back(static_cast<float>(std::min(girth.most_vx, radius)));
  // A seed has no segment of its own; it is as thick as what grows from it.
  std::vector<float> thickest(nodes, 0.0f);
  for (std::size_t n = 0; n < nodes; ++n) {
    if (skeleton.parent[n] == sim::kNoNode) continue;
    float& most = thickest[static_cast<std::size_t>(skeleton.parent[n])];
    most = std::max(most, radii[n]);
  }
  for (std::size_t n = 0; n < nodes; ++n) {
    if (skeleton.parent[n] == sim::kNoNode && thickest[n] > 0) radii[n] = thickest[n];
  }
  return radii;
}

}  // namespace espalier::render
