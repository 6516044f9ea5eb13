#include "render/model/radii.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/error.h"
#include "tests/support/small_vine.h"

namespace espalier {
namespace {

using render::PipeModel;
using render::pipeRadii;

TEST(Radii, EveryForkFollowsThePipeModel) {
  const sim::Skeleton skeleton = tests::smallVine().skeleton;
  const PipeModel model{2.05f, 0.1f, 100.0f};
  const auto radii = pipeRadii(skeleton, model);
  std::vector<double> children(radii.size(), 0.0);
  for (std::size_t n = 0; n < radii.size(); ++n) {
    if (skeleton.parent[n] != sim::kNoNode) {
      children[static_cast<std::size_t>(skeleton.parent[n])] += std::pow(static_cast<double>(radii[n]), 2.05);
    }
  }
  int forks = 0;
  for (std::size_t n = 0; n < radii.size(); ++n) {
    if (skeleton.parent[n] == sim::kNoNode) continue;
    if (children[n] == 0.0) {
      EXPECT_FLOAT_EQ(radii[n], model.tip_radius_vx);
    } else {
      EXPECT_NEAR(std::pow(static_cast<double>(radii[n]), 2.05) / children[n], 1.0, 1e-5);
      ++forks;
    }
  }
  EXPECT_GT(forks, 10);
}

TEST(Radii, AreCapped) {
  const auto radii = pipeRadii(tests::smallVine().skeleton, {2.05f, 0.1f, 0.15f});
  EXPECT_EQ(*std::max_element(radii.begin(), radii.end()), 0.15f);
}

TEST(Radii, TheExponentIsTheRule) {  // two equal twigs: Leonardo's sqrt(2), Murray's cube root
  sim::Skeleton skeleton;
  tests::addNode(skeleton, sim::kNoNode, {0, 0, 0});
  const auto trunk = tests::addNode(skeleton, 0, {0, 1, 0});
  tests::addNode(skeleton, trunk, {1, 2, 0});
  tests::addNode(skeleton, trunk, {-1, 2, 0});
  EXPECT_FLOAT_EQ(pipeRadii(skeleton, {2.0f, 1.0f, 9.0f})[1], std::sqrt(2.0f));
  EXPECT_FLOAT_EQ(pipeRadii(skeleton, {3.0f, 1.0f, 9.0f})[1], std::cbrt(2.0f));
}

TEST(Radii, NonsenseIsRefused) {
  EXPECT_THROW(pipeRadii({}, {0.0f, 0.1f, 1.0f}), sim::InputError);
  EXPECT_THROW(pipeRadii({}, {2.0f, -0.1f, 1.0f}), sim::InputError);
  EXPECT_THROW(pipeRadii({}, {2.0f, NAN, 1.0f}), sim::InputError);
}

}  // namespace
}  // namespace espalier
