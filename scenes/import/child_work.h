#pragma once
// Internal to the wing.
#include <sys/types.h>

#include <functional>
#include <string>

#include "scenes/import/child_process.h"

/// What happens in a child that works for its parent, and how it answers.
namespace espalier::scenes {

/// The first byte of an answer; what was made follows, or what went wrong.
inline constexpr char kFinished = 'F', kThrew = 'T', kOutOfMemory = 'M';

/// Ties this process to its parent: it ends when that ends, or now if that is gone already.
void endWith(pid_t parent);

/// From now on this process may use so much, and writes neither core files nor any others.
void enterLimits(const ChildLimits& limits);

/// What libraries print from now on is seen by nobody: the parent says better what went wrong.
void fallSilent();

/// What answerParent reads: what is asked, with this process and its limits.
std::string orderFor(const std::string& ask, const ChildLimits& limits);

/// Works, sends the answer and ends: nothing that was begun before is run or flushed.
[[noreturn]] void answer(const std::function<std::string()>& work, int to);

}  // namespace espalier::scenes
