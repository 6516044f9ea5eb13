#include "sim/light/givers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/light/sky.h"
#include "tests/support/levels.h"

namespace espalier::sim {
namespace {

/// In double precision, one by one.
TEST(Givers, GiveWhatTheyShouldAndSumsNeedNoOrder) {
  const Sky sky = makeSky({.directions = 150});
  std::vector<Givers::Amount> amounts;
  for (const LatticeDirection& d : sky.directions) {
    const Vec3f unit(glm::normalize(Vec3(d.v)));
    amounts.push_back({0.001f, 0.01f * unit.x, 0.01f * unit.y, 0.01f * unit.z});
  }
  std::mt19937_64 rng(3);
  const std::vector<Vec3f> normals = {{0, 1, 0},
                                      {0, -1, 0},
                                      {1, 0, 0},
                                      glm::normalize(Vec3f(1, 2, -3)),
                                      glm::normalize(Vec3f(-0.3f, 0.01f, 2))};
  for (const auto along : {Givers::Along::nothing, Givers::Along::half}) {
    const Givers givers(sky.directions, amounts, along);
    ASSERT_EQ(givers.words(), 3u);
    std::vector<std::uint64_t> bits(3);
    for (auto& word : bits) word = rng();
    std::vector<std::vector<std::uint32_t>> answers;
    tests::onEveryLevel([&] {
      std::vector<std::uint32_t> answer;
      for (const Vec3f& normal : normals) {
        std::vector<std::uint32_t> given(64 * givers.words());
        givers.give(normal, given.data());
        double plain = 0.0;
        for (std::size_t i = 0; i < given.size(); ++i) {
          double amount = 0.0;
          if (i < sky.directions.size()) {
            const Vec3 unit = glm::normalize(Vec3(sky.directions[i].v));
            const double cosine = glm::dot(unit, Vec3(normal));
            const bool level = along == Givers::Along::half;
            const double part = cosine > 1e-6 || (level && normal.y > 0.9999f)   ? 1.0
                                : level && cosine > -1e-6 && normal.y > -0.9999f ? 0.5
                                                                                 : 0.0;
            amount = part * (0.001 + 0.01 * cosine);
          }
          ASSERT_NEAR(givers.inFull(given[i]), amount, 1e-7) << i;
          if (((bits[i / 64] >> (i % 64)) & 1u) != 0) plain += amount;
        }
        const std::uint32_t sum = sumOfSet(bits.data(), given.data(), givers.words());
        EXPECT_NEAR(givers.inFull(sum), plain, 1e-6);
        answer.push_back(sum);
      }
      answers.push_back(answer);
    });
    for (const auto& answer : answers) EXPECT_EQ(answer, answers.front());
  }
}

}  // namespace
}  // namespace espalier::sim
