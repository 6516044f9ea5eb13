#pragma once

namespace espalier::scenes {

/// How much work this machine does in a second just now, in seconds of one core of the machine on which
/// scenes/foretell/costs.cpp was measured.
struct Speed {
  double one_core = 1.0, all_cores = 1.0;
};

/// Measures it, by rays through voxels, in some hundredths of a second.
Speed measuredSpeed();

/// Work by one thread, and work that all share.
struct Work {
  double alone_s = 0.0, shared_s = 0.0;
};

/// Seconds that work takes.
inline double secondsOf(const Work& work, const Speed& speed) {
  return work.alone_s / speed.one_core + work.shared_s / speed.all_cores;
}

}  // namespace espalier::scenes
