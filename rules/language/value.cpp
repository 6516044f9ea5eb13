#include "rules/language/value.h"

#include <algorithm>

namespace espalier::rules {
namespace {

double along(const std::vector<Value::Point>& curve, double x) {
  if (curve.empty()) return 0.0;
  if (x <= curve.front().x) return curve.front().y;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const auto& [x0, y0] = curve[i - 1];
    const auto& [x1, y1] = curve[i];
    if (x <= x1) return x1 > x0 ? y0 + (y1 - y0) * (x - x0) / (x1 - x0) : y1;
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
