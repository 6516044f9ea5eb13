#include "sim/base/stop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "sim/base/error.h"
#include "sim/base/parallel.h"

namespace espalier::sim {
namespace {

using namespace std::chrono_literals;

TEST(StopScope, IsInForceWhileItLivesAndNoLonger) {
  std::stop_source source;
  {
    const StopScope in_force(source.get_token());
    EXPECT_NO_THROW(throwIfStopped());
    source.request_stop();
    EXPECT_TRUE(stopRequested());
    EXPECT_THROW(throwIfStopped(), Stopped);
  }
  EXPECT_FALSE(stopRequested());
  EXPECT_NO_THROW(throwIfStopped());
}

TEST(StopScope, OneInsideAnotherHearsBoth) {
  std::stop_source outer, inner;
  const StopScope outside(outer.get_token());
  const StopScope inside(inner.get_token());
  outer.request_stop();
  EXPECT_THROW(throwIfStopped(), Stopped);
  EXPECT_FALSE(inner.stop_requested());
}

TEST(StopScope, EndsALoopThatHasBegun) {
  std::stop_source source;
  const StopScope in_force(source.get_token());
  std::atomic<int> done = 0;
  EXPECT_THROW(parallelForEach(100'000,
                               [&](std::size_t) {
                                 if (++done == 50) source.request_stop();
                               }),
               Stopped);
  EXPECT_LT(done, 100'000 / 2);
  EXPECT_THROW(parallelForEach(1, [&](std::size_t) { FAIL() << "a loop begun after the stop"; }), Stopped);
  EXPECT_THROW(parallelInvoke([] { FAIL(); }, [] { FAIL(); }), Stopped);
}

TEST(StopScope, ReachesLoopsInsideOfLoopsOnAnyThread) {
  std::stop_source source;
  const StopScope in_force(source.get_token());
  for (const int threads : {1, 2, 5}) {
    std::atomic<int> outer = 0, inner = 0;
    std::stop_source mine;
    const StopScope beside(mine.get_token());
    EXPECT_THROW(onThreads(threads,
                           [&] {
                             parallelForEach(40, [&](std::size_t) {
                               ++outer;
                               parallelForEach(40, [&](std::size_t) {
                                 parallelForEach(40, [&](std::size_t) {
                                   if (++inner == 300) mine.request_stop();
                                 });
                               });
                               ADD_FAILURE() << "a stopped loop went on behind itself";
                             });
                           }),
                 Stopped)
        << threads;
    EXPECT_LT(inner, 40 * 40 * 40 / 2) << threads;
  }
}

/// Two jobs of a process share its threads, and take up each other's work.
TEST(StopScope, OtherJobsOfTheProcessAreNotTouched) {
  std::stop_source source;
  std::atomic<bool> stopped = false;
  std::atomic<std::size_t> count = 0;
  std::thread other([&] {
    for (int round = 0; round < 20; ++round) {
      parallelForEach(50, [&](std::size_t) {
        parallelForEach(50, [&](std::size_t) {
          EXPECT_FALSE(stopRequested());
          ++count;
        });
      });
    }
  });
  {
    const StopScope in_force(source.get_token());
    try {
      for (;;) {
        parallelForEach(50, [&](std::size_t) {
          parallelForEach(50, [&](std::size_t) { throwIfStopped(); });
          if (count > 5000) source.request_stop();
        });
      }
    } catch (const Stopped&) {
      stopped = true;
    }
  }
  other.join();
  EXPECT_TRUE(stopped);
  EXPECT_EQ(count, 20u * 50u * 50u);
}

/// Each hears its own, at whatever depth, on whatever threads, and however often.
TEST(StopScope, TwoJobsWithTokensOfTheirOwnHearThoseAlone) {
  std::atomic<int> wrong = 0, heard = 0;
  const auto job = [&](int threads) {
    for (int round = 0; round < 200; ++round) {
      std::stop_source mine;
      const StopScope in_force(mine.get_token());
      std::atomic<int> count = 0;
      try {
        onThreads(threads, [&] {
          parallelForEach(30, [&](std::size_t) {
            parallelInvoke(
                [&] {
                  parallelForEach(30, [&](std::size_t) {
                    if (stopRequested() && !mine.stop_requested()) ++wrong;
                    if (++count == 400) mine.request_stop();
                  });
                },
                [] { throwIfStopped(); });
          });
        });
        ++wrong;
      } catch (const Stopped&) {
        ++(mine.stop_requested() ? heard : wrong);
      }
      if (count < 400) ++wrong;
    }
  };
  {
    const std::jthread one(job, 2), another(job, 3);
    job(1);
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(heard, 3 * 200);
}

/// What is built on one thread, to be the same every time, leaves the others theirs.
TEST(OnThreads, HoldsNoOtherJobBack) {
  if (threadCount() < 2) GTEST_SKIP() << "one thread is all that there is";
  std::stop_source over;
  std::atomic<bool> begun = false;
  const std::jthread alone([&] {
    onThreads(1, [&] {
      begun = true;
      while (!over.stop_requested()) std::this_thread::sleep_for(1ms);
    });
  });
  while (!begun) std::this_thread::sleep_for(1ms);
  std::atomic<int> met = 0;
  const auto until = std::chrono::steady_clock::now() + 20s;
  parallelForEach(2, [&](std::size_t) {
    ++met;
    while (met < 2 && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(1ms);
    EXPECT_EQ(met, 2) << "they were to run at the same time";
  });
  over.request_stop();
}

TEST(StopScope, AFailureBeforeTheStopIsStillAStop) {
  std::stop_source source;
  const StopScope in_force(source.get_token());
  EXPECT_THROW(parallelForEach(1000,
                               [&](std::size_t i) {
                                 source.request_stop();
                                 if (i == 0) throw InputError("half done");
                               }),
               Stopped);
}

}  // namespace
}  // namespace espalier::sim
