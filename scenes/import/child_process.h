#pragma once
#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace espalier::scenes {

/// What a child process may use before it is ended.
struct ChildLimits {
  std::chrono::seconds cpu{20};
  std::chrono::milliseconds wall{60000};
  std::size_t memory_bytes = std::size_t{3}
                             << 30;  ///< on top of what the parent has mapped; not set under sanitizers
  std::size_t result_bytes = std::size_t{2} << 30;  ///< the longest answer that the parent takes
};

enum class ChildEnd { finished, threw, crashed, out_of_time, out_of_memory };

struct ChildResult {
  ChildEnd end = ChildEnd::crashed;
  std::string bytes;  ///< finished: what `work` returned; threw: its exception's text; crashed: how it ended
};

/// Runs `work` in a forked child under `limits` and hands back what it returned. Whatever the child does
/// (crash, hang, eat memory) the parent lives on. A Ctrl-C that ends the child is thrown as sim::Stopped, and
/// where the job is stopped (sim/base/stop.h) the child is ended.
///
/// A plain fork, without exec: of a process with several threads only the calling one lives on in the child,
/// so `work` must not touch anything that another thread may have held locked, oneTBB's scheduler above all.
/// glibc makes malloc usable in the child; other code must stay away from shared locks. Mesh import does: it
/// runs before any world exists and calls nothing but malloc, file reading and Assimp.
ChildResult runInChild(const std::function<std::string()>& work, const ChildLimits& limits);

}  // namespace espalier::scenes
