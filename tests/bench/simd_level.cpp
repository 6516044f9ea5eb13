// Compiled for each instruction set, as the sweep is: the one that Highway calls names itself.
#include <string>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/simd_level.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace espalier::bench::HWY_NAMESPACE {
std::string level() {
  return hwy::TargetName(HWY_TARGET);
}
}  // namespace espalier::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "tests/bench/machine.h"

namespace espalier::bench {
HWY_EXPORT(level);
std::string simdLevel() {
  return HWY_DYNAMIC_DISPATCH(level)();
}
}  // namespace espalier::bench
#endif
