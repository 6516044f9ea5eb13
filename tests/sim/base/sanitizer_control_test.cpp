#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <thread>
#include <vector>

#include "sim/base/parallel.h"

/// Faults on purpose, run by tests/sanitize.sh alone: a sanitizer that says nothing here is not at work, or
/// its suppressions hide too much.
namespace espalier::tests {
namespace {

TEST(SanitizerControl, DISABLED_tsan_BodiesOfALoopRace) {
  std::atomic<int> begun = 0;
  int racing = 0;
  sim::onThreads(2, [&] {
    sim::parallelForEach(2, [&](std::size_t) {
      begun.fetch_add(1, std::memory_order_relaxed);  // orders nothing, and lets both be at work at once
      const auto late = std::chrono::steady_clock::now() + std::chrono::seconds(20);
      while (begun.load(std::memory_order_relaxed) < 2 && std::chrono::steady_clock::now() < late)
        std::this_thread::yield();
      ++racing;
    });
  });
  EXPECT_GT(racing, 0);
}

TEST(SanitizerControl, DISABLED_asan_ReadsBeyondTheEnd) {
  const std::vector<int> three(3);
  volatile std::size_t beyond = 3;
  EXPECT_GE(three.data()[beyond] | 1, std::numeric_limits<int>::min());
}

TEST(SanitizerControl, DISABLED_asan_OverflowsAnInt) {
  volatile int most = std::numeric_limits<int>::max();
  EXPECT_NE(most + 1, 0);
}

}  // namespace
}  // namespace espalier::tests
