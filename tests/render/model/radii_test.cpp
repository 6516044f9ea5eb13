#include "render/model/radii.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "tests/support/small_vine.h"

namespace espalier {
namespace {

using render::stemRadii;
using sim::StemGirth;

/// Radii to a power at each node and summed over its children.
struct Sums {
  std::vector<double> own, children;
};
Sums sumsOf(const sim::Skeleton& skeleton, const std::vector<float>& radii, double exponent) {
  Sums sums{std::vector<double>(radii.size()), std::vector<double>(radii.size(), 0.0)};
  for (std::size_t n = 0; n < radii.size(); ++n) {
    sums.own[n] = std::pow(static_cast<double>(radii[n]), exponent);
    if (skeleton.parent[n] != sim::kNoNode)
      sums.children[static_cast<std::size_t>(skeleton.parent[n])] += sums.own[n];
  }
  return sums;
}

TEST(Radii, SideLimbsAreSlenderByTheirOrder) {
  sim::Skeleton skeleton;
  const auto add = [&](sim::NodeId parent, sim::Vec3 at) { return tests::addNode(skeleton, parent, at); };
  const auto seed = add(sim::kNoNode, {0, 0, 0}), fork = add(seed, {0, 2, 0});
  const auto side = add(fork, {2, 3, 0}),
             straight = add(fork, {0, 4, 0});  // as thick: the straight one goes on
  const auto twig = add(side, {3, 5, 0}), on = add(side, {4, 4, 0}), tip = add(straight, {1, 6, 0}),
             other = add(straight, {-1, 6, 0.5});
  const StemGirth plain{.twig_vx = 0.1};
  StemGirth slender = plain;
  slender.order_share = 0.5;
  const auto full = stemRadii(skeleton, plain), radii = stemRadii(skeleton, slender);
  const auto share = [&](sim::NodeId n) {
    return radii[static_cast<std::size_t>(n)] / full[static_cast<std::size_t>(n)];
  };
  for (const auto n : {seed, fork, straight}) EXPECT_FLOAT_EQ(share(n), 1.0f);
  for (const auto n : {side, on}) EXPECT_FLOAT_EQ(share(n), 0.5f);
  EXPECT_FLOAT_EQ(share(twig), 0.25f);
  EXPECT_FLOAT_EQ(share(tip) * share(other), 0.5f) << "one of the two goes on";
  skeleton.columns["order"] = {0, 0, 3, 0, 3, 3, 0, 0};  // as a process may count
  const auto counted = stemRadii(skeleton, slender);
  EXPECT_FLOAT_EQ(counted[static_cast<std::size_t>(side)], 0.125f * full[static_cast<std::size_t>(side)]);
  slender.order_share = 0.0;
  EXPECT_THROW(stemRadii(skeleton, slender), sim::InputError);
}

TEST(Radii, EveryForkFollowsThePipeModel) {
  const sim::Skeleton skeleton = tests::smallVine().skeleton;
  const auto radii = stemRadii(skeleton, {.twig_vx = 0.1});
  const Sums sums = sumsOf(skeleton, radii, 2.05);
  int forks = 0;
  for (std::size_t n = 0; n < radii.size(); ++n) {
    if (skeleton.parent[n] == sim::kNoNode) continue;
    if (sums.children[n] == 0.0) {
      EXPECT_FLOAT_EQ(radii[n], 0.1f);
    } else {
      EXPECT_NEAR(sums.own[n] / sums.children[n], 1.0, 1e-5);
      ++forks;
    }
  }
  EXPECT_GT(forks, 10);
}

TEST(Radii, ThatAreGivenAreTaken) {
  sim::Skeleton skeleton;
  skeleton.parent = {sim::kNoNode, 0, 1, 1, 0};
  skeleton.position_vx = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {1, 2, 0}, {1, 0, 0}};
  skeleton.born = {0, 0, 1, 1, 0};
  skeleton.columns[sim::kRadiusColumn] = {0.0f, 2.0f, 3.0f, std::nanf(""), 0.5f};
  EXPECT_EQ(stemRadii(skeleton, {.twig_vx = 0.25}), (std::vector<float>{2.0f, 2.0f, 3.0f, 0.25f, 0.5f}));
  EXPECT_EQ(stemRadii(skeleton, {.by = StemGirth::By::age, .twig_vx = 0.25, .most_vx = 2.5}),
            (std::vector<float>{2.0f, 2.0f, 2.5f, 0.25f, 0.5f}));
}

TEST(Radii, AreCappedOnlyWhereAsked) {
  const sim::Skeleton skeleton = tests::smallVine().skeleton;
  const auto capped = stemRadii(skeleton, {.twig_vx = 0.1, .most_vx = 0.15});
  EXPECT_EQ(*std::max_element(capped.begin(), capped.end()), 0.15f);
  const auto free = stemRadii(skeleton, {.twig_vx = 10.0});
  EXPECT_FLOAT_EQ(free[0], 100.0f * stemRadii(skeleton, {.twig_vx = 0.1})[0]);
}

/// A trunk with two equal twigs.
sim::Skeleton twoTwigs() {
  sim::Skeleton skeleton;
  tests::addNode(skeleton, sim::kNoNode, {0, 0, 0});
  const auto trunk = tests::addNode(skeleton, 0, {0, 1, 0}, 1);
  tests::addNode(skeleton, trunk, {1, 2, 0}, 4);
  tests::addNode(skeleton, trunk, {-1, 2, 0}, 10);
  return skeleton;
}

TEST(Radii, TheExponentIsTheRule) {  // Leonardo's sqrt(2), Murray's cube root
  EXPECT_FLOAT_EQ(stemRadii(twoTwigs(), {.twig_vx = 1.0, .exponent = 2.0})[1], std::sqrt(2.0f));
  EXPECT_FLOAT_EQ(stemRadii(twoTwigs(), {.twig_vx = 1.0, .exponent = 3.0})[1], std::cbrt(2.0f));
  EXPECT_FLOAT_EQ(stemRadii(twoTwigs(), {.twig_vx = 1.0, .exponent = 1.0})[1], 2.0f);
}

TEST(Radii, ByAgeEachIterationAddsAsMuch) {
  const StemGirth girth{.by = StemGirth::By::age, .twig_vx = 0.5, .thickens_vx = 0.25, .most_vx = 2.5};
  EXPECT_EQ(stemRadii(twoTwigs(), girth), (std::vector<float>{2.5f, 2.5f, 2.0f, 0.5f}));
}

TEST(Radii, NonsenseIsRefused) {
  EXPECT_THROW(stemRadii({}, {.exponent = 0.9}), sim::InputError);
  EXPECT_THROW(stemRadii({}, {.twig_vx = -0.1}), sim::InputError);
  EXPECT_THROW(stemRadii({}, {.twig_vx = NAN}), sim::InputError);
  EXPECT_THROW(stemRadii({}, {.most_vx = 0.0}), sim::InputError);
}

}  // namespace
}  // namespace espalier
