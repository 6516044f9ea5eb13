#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/support/levels.h"

namespace espalier {
namespace {

TEST(Transpose, TurnsRowsIntoColumns) {
  tests::onEveryLevel([] {
    std::mt19937_64 rng(7);
    alignas(64) std::array<std::uint64_t, 64> square;
    for (auto& row : square) row = rng();
    const auto before = square;
    sim::lanes::transpose(square.data());
    for (std::size_t i = 0; i < 64; ++i) {
      for (std::size_t j = 0; j < 64; ++j)
        ASSERT_EQ((square[i] >> j) & 1u, (before[j] >> i) & 1u) << i << ' ' << j;
    }
    sim::lanes::transpose(square.data());
    EXPECT_EQ(square, before);
  });
}

}  // namespace
}  // namespace espalier
