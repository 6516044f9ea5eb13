#pragma once
#include <gtest/gtest.h>

#include <functional>

#include "sim/sweep/lanes.h"

namespace espalier::tests {

/// Runs a check with every set of vector instructions that this processor has.
inline void onEveryLevel(const std::function<void()>& check) {
  const auto levels = sim::lanes::levels();
  for (const std::string& level : levels) {
    SCOPED_TRACE(level);
    sim::lanes::useLevel(level);
    EXPECT_EQ(sim::lanes::level(), level);
    check();
  }
  sim::lanes::useLevel(levels.front());
}

}  // namespace espalier::tests
