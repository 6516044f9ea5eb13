#include "sim/base/counted.h"

#include <gtest/gtest.h>

namespace espalier::sim {
namespace {

TEST(Counted, OneIsOneAndAllElseIsMany) {
  EXPECT_EQ(counted(0, "plant"), "0 plants");
  EXPECT_EQ(counted(1, "plant"), "1 plant");
  EXPECT_EQ(counted(2, "plant"), "2 plants");
  EXPECT_EQ(counted(1, "leaf", "leaves"), "1 leaf");
  EXPECT_EQ(counted(0, "leaf", "leaves"), "0 leaves");
  EXPECT_EQ(counted(12, "more is", "more are"), "12 more are");
}

}  // namespace
}  // namespace espalier::sim
