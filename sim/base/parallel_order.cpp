#include "sim/base/parallel_order.h"

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>

extern "C" {  // of ThreadSanitizer's library, in no header
void AnnotateIgnoreReadsBegin(const char* file, int line);
void AnnotateIgnoreReadsEnd(const char* file, int line);
void AnnotateIgnoreWritesBegin(const char* file, int line);
void AnnotateIgnoreWritesEnd(const char* file, int line);
}

namespace espalier::sim {
namespace {

/// Whether what this thread reads and writes is judged. What a thread does between our bodies is oneTBB's own
/// affair, or a loop inside of OpenVDB: both rely on the order that cannot be seen.
class Attention {
 public:
  ~Attention() { judge(true); }  // a thread must not end unjudged
  void judge(bool wanted) {
    if (wanted == judged_) return;
    judged_ = wanted;
    if (wanted) {
      AnnotateIgnoreWritesEnd(__FILE__, __LINE__);
      AnnotateIgnoreReadsEnd(__FILE__, __LINE__);
    } else {
      AnnotateIgnoreReadsBegin(__FILE__, __LINE__);
      AnnotateIgnoreWritesBegin(__FILE__, __LINE__);
    }
  }

 private:
  bool judged_ = true;
};

thread_local Attention attention;

}  // namespace

void LoopOrder::before() {
  __tsan_release(&begun_);
  attention.judge(false);
}

void LoopOrder::bodyBegins() {
  attention.judge(true);
  __tsan_acquire(&begun_);
}

void LoopOrder::bodyEnds() {
  __tsan_release(&ended_);
  attention.judge(false);
}

void LoopOrder::after() {
  attention.judge(true);
  __tsan_acquire(&ended_);
}

}  // namespace espalier::sim
#endif
