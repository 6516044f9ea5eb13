#include "rules/language/value.h"

#include <gtest/gtest.h>

#include <limits>

namespace espalier::rules {
namespace {

TEST(Value, AConstantIsItself) {
  EXPECT_EQ(evaluate(2.5, {}, 0.9), 2.5);
}

TEST(Value, ARangeIsDrawnFrom) {
  Value range;
  range.kind = Value::Kind::range;
  range.low = 2.0;
  range.high = 4.0;
  EXPECT_EQ(evaluate(range, {}, 0.0), 2.0);
  EXPECT_EQ(evaluate(range, {}, 0.5), 3.0);
  EXPECT_EQ(lowest(range), 2.0);
  EXPECT_EQ(highest(range), 4.0);
}

TEST(Value, ACurveIsLinearBetweenItsPointsAndConstantBeyond) {
  Value curve;
  curve.kind = Value::Kind::curve;
  curve.curve = {{0.2, 1.0}, {0.6, 3.0}, {1.0, 2.0}};
  for (const auto& [x, y] :
       {std::pair{0.0, 1.0}, {0.2, 1.0}, {0.4, 2.0}, {0.6, 3.0}, {0.8, 2.5}, {1.5, 2.0}}) {
    EXPECT_NEAR(evaluate(curve, {x, 0.0, 0.0}, 0.5), y, 1e-12);
  }
  curve.over = Over::age;
  EXPECT_NEAR(evaluate(curve, {0.0, 0.4, 0.0}, 0.5), 2.0, 1e-12);
  curve.over = Over::height;
  EXPECT_NEAR(evaluate(curve, {0.0, 0.0, 0.4}, 0.5), 2.0, 1e-12);
  EXPECT_EQ(lowest(curve), 1.0);
  EXPECT_EQ(highest(curve), 3.0);
}

TEST(Value, ACurveMayReachAsFarAsNumbersDo) {
  constexpr double kMost = std::numeric_limits<double>::max();
  Value curve;
  curve.kind = Value::Kind::curve;
  curve.curve = {{-kMost, 18.0}, {2.0, 10.0}};
  EXPECT_DOUBLE_EQ(evaluate(curve, {1.0, 0.0, 0.0}, 0.5), 10.0);
  curve.curve = {{-kMost, 18.0}, {kMost, 10.0}};
  EXPECT_DOUBLE_EQ(evaluate(curve, {0.0, 0.0, 0.0}, 0.5), 14.0);
  curve.curve = {{-kMost, 0.25}, {kMost, 0.75}};
  EXPECT_DOUBLE_EQ(evaluate(curve, {1.0, 0.0, 0.0}, 0.5), 0.5);
}

}  // namespace
}  // namespace espalier::rules
