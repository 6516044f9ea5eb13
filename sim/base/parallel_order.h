#pragma once
// Internal to the room: what ThreadSanitizer must be told of the thread pool. Nothing in any other build.

/// For the function that oneTBB calls: it must read where its LoopOrder lies before the order is known.
#define ESPALIER_UNORDERED __attribute__((no_sanitize("thread")))

namespace espalier::sim {

/// The order that one loop makes. oneTBB is not compiled with ThreadSanitizer, which therefore cannot see it:
/// what came before the loop has happened when one of its bodies begins, and all bodies when the loop is
/// done. Nothing is said of bodies among themselves, so that their races are found.
class LoopOrder {
 public:
#ifdef __SANITIZE_THREAD__
  void before();      ///< by the caller
  void bodyBegins();  ///< by any thread
  void bodyEnds();
  void after();  ///< by the caller again

 private:
  alignas(8) char begun_ = 0;
  alignas(8) char ended_ = 0;
#else
  void before() {}
  void bodyBegins() {}
  void bodyEnds() {}
  void after() {}
#endif
};

}  // namespace espalier::sim
