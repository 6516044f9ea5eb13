#pragma once
#include <cstddef>
#include <functional>

/// The one door to the thread pool (oneTBB). Only loops whose iterations write to places of their own: no
/// unordered reductions are offered, so that no answer can depend on the number of threads. Where the job is
/// stopped (sim/base/stop.h), ranges that have not begun are left out and the loop throws Stopped.
namespace espalier::sim {

/// Calls body(begin, end) on disjoint ranges that cover [0, count).
void parallelFor(std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& body);

/// As parallelFor, with ranges of at most `grain` items: for few, dear items.
void parallelFor(std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls body(i) for each i below count, each as a task of its own.
void parallelForEach(std::size_t count, const std::function<void(std::size_t i)>& body);

/// Runs both at the same time.
void parallelInvoke(const std::function<void()>& a, const std::function<void()>& b);

/// While one lives, every loop gives way at random before each of its ranges: tests meet orders of work that
/// they would otherwise never see.
class Shaken {
 public:
  Shaken();
  ~Shaken();
  Shaken(const Shaken&) = delete;
  Shaken& operator=(const Shaken&) = delete;
};

/// How many threads a loop may use here.
int threadCount();

/// Runs work on so many threads, more than the machine has cores if asked.
void onThreads(int threads, const std::function<void()>& work);

}  // namespace espalier::sim
