#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::rules {

/// What a curve's x axis stands for; `sense`: one of the rule set's own senses, by its name.
enum class Over { exposure, age, height, sense };
/// The words of all but senses, in their order.
inline constexpr std::array kAxes{"exposure", "age", "height"};

/// A number of a rule: a constant, a range from which each use draws evenly, or a curve over a quantity of
/// the node that uses it (piecewise linear, constant beyond its ends).
struct Value {
  enum class Kind { constant, range, curve };
  struct Point {
    double x, y;
    friend bool operator==(const Point&, const Point&) = default;
  };

  Kind kind = Kind::constant;
  double low = 0.0;   ///< the constant, or the range's lower end
  double high = 0.0;  ///< the range's upper end
  Over over = Over::exposure;
  std::string sense = {};    ///< which, of Over::sense
  std::vector<Point> curve;  ///< sorted by x

  Value() = default;
  Value(double constant) : low(constant), high(constant) {}  // NOLINT: a number is a value
  friend bool operator==(const Value&, const Value&) = default;
};

/// What a sense of a rule set has read.
struct Reading {
  std::string_view sense;
  double value = 0.0;
};

/// What a value may depend on.
struct Circumstance {
  double exposure = 1.0;  ///< 0..1
  double age = 0.0;       ///< iterations since the plant was seeded
  double height_m = 0.0;  ///< above the world's floor
  std::vector<Reading> readings = {};
};

/// `draw` in [0, 1) picks from a range.
double evaluate(const Value& value, const Circumstance& at, double draw);
double lowest(const Value& value);
double highest(const Value& value);

}  // namespace espalier::rules
