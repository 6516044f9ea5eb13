#include "sim/base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <random>
#include <thread>

#include "sim/base/error.h"
#include "sim/base/parallel_order.h"
#include "sim/base/stop.h"

namespace espalier::sim {
namespace {

/// Keeps exceptions out of oneTBB: one that left a task would cancel the loops that other tasks run inside of
/// themselves, and libraries such as OpenVDB do not survive their half-done results. The first in order is
/// thrown when all is done, so that the same input has the same error on any number of threads. Where the job
/// is stopped, what has not begun is left out; what its caller put in force holds for each work alone, as a
/// thread that waits in a loop of one job may take up a work of another.
class Failures {
 public:
  template <typename Work>
  void guard(std::size_t place, const Work& work) noexcept {
    const HandedStops::Scope in_force(stops_);
    try {
      if (stopRequested()) {
        stopped_.store(true, std::memory_order_relaxed);
      } else {
        work();
      }
    } catch (const Stopped&) {
      stopped_.store(true, std::memory_order_relaxed);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (place < first_) {
        first_ = place;
        failure_ = std::current_exception();
      }
    }
  }
  void rethrow() const {
    if (stopped_.load(std::memory_order_relaxed)) throw Stopped();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  const HandedStops stops_;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  std::size_t first_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr failure_;
};

std::atomic<int> shaken = 0;

void giveWay() {
  thread_local std::minstd_rand random{std::random_device{}()};
  switch (random() % 8) {
    case 0:
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 100));
      break;
    case 1:
    case 2:
      std::this_thread::yield();
      break;
    default:
      break;
  }
}

using Body = std::function<void(std::size_t, std::size_t)>;

template <typename... Partitioner>
void loop(const tbb::blocked_range<std::size_t>& all, const Body& body, const Partitioner&... partitioner) {
  Failures failures;
  LoopOrder order;
  order.before();
  tbb::parallel_for(
      all,
      [&](const tbb::blocked_range<std::size_t>& range) ESPALIER_UNORDERED {
        order.bodyBegins();
        if (shaken.load(std::memory_order_relaxed) > 0) giveWay();
        failures.guard(range.begin(), [&] { body(range.begin(), range.end()); });
        order.bodyEnds();
      },
      partitioner...);
  order.after();
  failures.rethrow();
}

}  // namespace

void parallelFor(std::size_t count, const Body& body) {
  loop({0, count}, body);
}

void parallelFor(std::size_t count, std::size_t grain, const Body& body) {
  loop({0, count, grain}, body, tbb::simple_partitioner());
}

void parallelForEach(std::size_t count, const std::function<void(std::size_t)>& body) {
  parallelFor(count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

void parallelInvoke(const std::function<void()>& a, const std::function<void()>& b) {
  Failures failures;
  LoopOrder order;
  const auto run = [&](std::size_t place, const std::function<void()>& work) ESPALIER_UNORDERED {
    order.bodyBegins();
    failures.guard(place, work);
    order.bodyEnds();
  };
  order.before();
  tbb::parallel_invoke([&]() ESPALIER_UNORDERED { run(0, a); }, [&]() ESPALIER_UNORDERED { run(1, b); });
  order.after();
  failures.rethrow();
}

Shaken::Shaken() {
  ++shaken;
}
Shaken::~Shaken() {
  --shaken;
}

int threadCount() {
  return tbb::this_task_arena::max_concurrency();
}

void onThreads(int threads, const std::function<void()>& work) {
  // For more than the machine has alone: less would hold back all other jobs of the process. Loops inside of
  // the arena have no more threads than it has.
  std::optional<tbb::global_control> more;
  if (threads > tbb::info::default_concurrency())
    more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  const HandedStops stops;
  arena.execute([&] {  // on another thread, should the arena be full
    const HandedStops::Scope in_force(stops);
    work();
  });
}

}  // namespace espalier::sim
