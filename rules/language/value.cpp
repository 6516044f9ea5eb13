#include "rules/language/value.h"

#include <algorithm>
#include <cmath>

namespace espalier::rules {
namespace {

/// The value at x of the line through two points, x0 < x1.
double onLine(const Value::Point& a, const Value::Point& b, double x) {
  const double rise = (b.y - a.y) * (x - a.x), run = b.x - a.x;
  if (std::isfinite(rise) && std::isfinite(run)) return a.y + rise / run;
  // So far apart that their difference is no number.
  return a.y + (b.y - a.y) * ((0.5 * x - 0.5 * a.x) / (0.5 * b.x - 0.5 * a.x));
}

double along(const std::vector<Value::Point>& curve, double x) {
  if (curve.empty()) return 0.0;
  if (x <= curve.front().x) return curve.front().y;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const Value::Point &before = curve[i - 1], &behind = curve[i];
    if (x <= behind.x) return behind.x > before.x ? onLine(before, behind, x) : behind.y;
  }
  return curve.back().y;
}

}  // namespace

double evaluate(const Value& value, const Circumstance& at, double draw) {
  switch (value.kind) {
    case Value::Kind::constant:
      return value.low;
    case Value::Kind::range:
      return value.low + (value.high - value.low) * draw;
    case Value::Kind::curve:
      break;
  }
  switch (value.over) {
    case Over::exposure:
      return along(value.curve, at.exposure);
    case Over::age:
      return along(value.curve, at.age);
    case Over::height:
      return along(value.curve, at.height_m);
    case Over::sense:
      for (const Reading& reading : at.readings) {
        if (reading.sense == value.sense) return along(value.curve, reading.value);
      }
      return value.low;  // rules/language/sense_keys.h refuses curves over what is not there
  }
  return value.low;
}

double lowest(const Value& value) {
  if (value.kind != Value::Kind::curve) return std::min(value.low, value.high);
  double y = value.curve.empty() ? 0.0 : value.curve.front().y;
  for (const auto& point : value.curve) y = std::min(y, point.y);
  return y;
}

double highest(const Value& value) {
  if (value.kind != Value::Kind::curve) return std::max(value.low, value.high);
  double y = value.curve.empty() ? 0.0 : value.curve.front().y;
  for (const auto& point : value.curve) y = std::max(y, point.y);
  return y;
}

}  // namespace espalier::rules
