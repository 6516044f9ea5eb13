#pragma once
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace espalier::scenes {

/// What a child process may use before it is ended.
struct ChildLimits {
  std::chrono::seconds cpu{20};
  std::chrono::milliseconds wall{60000};
  std::size_t memory_bytes =
      std::size_t{3} << 30;  ///< on top of what it has mapped when it begins; not set under sanitizers
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
/// glibc makes malloc usable in the child; other code must stay away from shared locks. Where other threads
/// are at work, as in a server, runInProgram is the safe way.
ChildResult runInChild(const std::function<std::string()>& work, const ChildLimits& limits);

/// The same by a child that begins afresh, and so safe beside any threads: executes `program`, with
/// kAnswerFlag alone, which is to call answerParent first of all; `ask` is handed to it there. `limits` hold
/// from where its work begins; it costs the start of a program. Throws std::runtime_error where it cannot be
/// started.
ChildResult runInProgram(const std::filesystem::path& program, const std::string& ask,
                         const ChildLimits& limits);

/// How a program knows that it is such a child.
inline constexpr const char* kAnswerFlag = "--read-a-file";

/// What such a child is there for: `workFor` what it is asked makes ready, not limited yet, and returns the
/// work.
[[noreturn]] void answerParent(
    const std::function<std::function<std::string()>(const std::string& ask)>& workFor);

}  // namespace espalier::scenes
