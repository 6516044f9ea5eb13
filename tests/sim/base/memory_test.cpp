#include "sim/base/memory.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>

#include "sim/base/hasher.h"
#include "tests/support/scratch.h"

namespace espalier::sim {
namespace {

TEST(Memory, TheLeastLimitOfAControlGroupAndThoseAroundItHolds) {
  const tests::Scratch scratch;
  scratch.write("two/memory.max", "9000000000\n");
  scratch.write("two/a/memory.max", "max\n");
  scratch.write("two/a/b/memory.max", "7000000000\n");
  scratch.write("one/memory/memory.limit_in_bytes", "9223372036854771712\n");
  scratch.write("one/memory/jobs/memory.limit_in_bytes", "5000000\n");
  const auto limit = [&](const char* about, const char* root) {
    return controlGroupLimit(about, scratch.path(root));
  };
  EXPECT_EQ(limit("0::/a/b\n", "two"), 7e9);
  EXPECT_EQ(limit("0::/a\n", "two"), 9e9);
  EXPECT_EQ(limit("0::/\n", "two"), 9e9);
  EXPECT_EQ(limit("5:cpu,memory:/jobs\n1:name=x:/other\n0::/\n", "one"), 5e6);
  EXPECT_EQ(limit("5:cpu:/jobs\n", "one"), INFINITY);
  EXPECT_EQ(limit("0::/../..\n", "two"), 9e9);  // of a group outside of what is mounted
  EXPECT_EQ(limit("nothing of the kind", "none"), INFINITY);
  EXPECT_EQ(limit("", "none"), INFINITY);
}

TEST(Memory, ThereIsSomeAndNotAllOfTheMachines) {
  EXPECT_GT(memoryBudget(), 1e7);
  const auto pages = static_cast<double>(::sysconf(_SC_PHYS_PAGES));
  EXPECT_LT(memoryBudget(),
            0.75 * pages * static_cast<double>(::sysconf(_SC_PAGE_SIZE)));  // others take some
  EXPECT_EQ(memoryBudget(), memoryBudget());
  EXPECT_EQ(inGigabytes(1.5 * 1024 * 1024 * 1024), "1.5 GB");
}

TEST(Hasher, HashOfBytesIsTheOneThatIsKnownEverywhere) {
  EXPECT_EQ(hashOf(""), 0x2d06800538d394c2u);  // xxhsum -H3 </dev/null
}

TEST(Memory, WhatTheMachineCanStillGiveIsRead) {
  EXPECT_EQ(availableIn(
                "MemTotal:       24684092 kB\nMemFree:  8 kB\nMemAvailable:   22472484 kB\nBuffers: 1 kB\n"),
            22472484.0 * 1024.0);
  EXPECT_TRUE(std::isinf(availableIn("MemTotal: 24684092 kB\nMemFree: 18488304 kB\n")));
  EXPECT_TRUE(std::isinf(availableIn("MemAvailable: much")));
  EXPECT_TRUE(std::isinf(availableIn("")));
}

}  // namespace
}  // namespace espalier::sim
