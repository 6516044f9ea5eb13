#pragma once
#include <stop_token>

/// How a job is told to stop. What may take long asks now and then, by throwIfStopped; loops of
/// sim/base/parallel.h ask before each of their ranges.
namespace espalier::sim {

/// While it lives, a token is in force on this thread, and on others in the loops that this thread begins,
/// beside those that were in force before. A job opens one where it begins; other jobs of the process do not
/// see it.
class StopScope {
 public:
  explicit StopScope(std::stop_token token);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  friend bool stopRequested();
  std::stop_token token_;
  const StopScope* outer_;
};

/// Whether one of the tokens that are in force here asks to stop.
bool stopRequested();

/// Throws Stopped if so. A few nanoseconds: for every row, slice or triangle, not for every voxel.
void throwIfStopped();

/// The tokens in force where it is made, to be put in force on another thread. They must outlive it.
class HandedStops {
 public:
  HandedStops();

  /// While it lives, they and no others are in force on this thread.
  class Scope {
   public:
    explicit Scope(const HandedStops& stops);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    const StopScope* before_;
  };

 private:
  const StopScope* innermost_;
};

}  // namespace espalier::sim
