#include "rules/language/key.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "rules/language/colour.h"
#include "sim/light/sun.h"

namespace espalier::rules {
namespace {

std::string inUnit(const Key& key) {
  return key.unit.empty() ? "" : fmt::format(" ({})", key.unit);
}

std::string bounded(const Key& key, std::string_view noun) {
  const auto range = rangeText(key.limits);
  if (range.empty()) return fmt::format("{}{}", noun, inUnit(key));
  const bool from = key.limits.above || std::isinf(key.limits.min) || std::isinf(key.limits.max);
  return fmt::format("{} {}{}{}", noun, from ? "that is " : "from ", range, inUnit(key));
}

std::string written(const Value& value, std::string_view unit) {
  switch (value.kind) {
    case Value::Kind::constant:
      return fmt::format("{}{}", value.low, unit);
    case Value::Kind::range:
      return fmt::format("[{}{}, {}{}]", value.low, unit, value.high, unit);
    case Value::Kind::curve:
      break;
  }
  std::string points;
  for (const auto& [x, y] : value.curve)
    points += fmt::format("{}[{}, {}{}]", points.empty() ? "" : ", ", x, y, unit);
  const std::string over =
      value.over == Over::sense ? value.sense : kAxes.at(static_cast<std::size_t>(value.over));
  return fmt::format("{{over: {}, points: [{}]}}", over, points);
}

struct Writer {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(bool flag) const { return flag ? "true" : "false"; }
  std::string operator()(std::int64_t whole) const { return fmt::format("{}", whole); }
  std::string operator()(const WholeRange& r) const { return fmt::format("[{}, {}]", r.low, r.high); }
  std::string operator()(double number) const {
    return std::isfinite(number) ? fmt::format("{}", number) : "";
  }
  std::string operator()(const Value& value) const { return written(value, ""); }
  std::string operator()(const Length& length) const {
    return written(length.value, length.metres ? " m" : "");
  }
  std::string operator()(const Distance& distance) const {
    return std::isfinite(distance.number) ? fmt::format("{}{}", distance.number, distance.metres ? " m" : "")
                                          : "";
  }
  std::string operator()(const sim::Colour& colour) const {
    return fmt::format("\"{}\"", hexFromLinear(colour));
  }
  std::string operator()(const sim::Vec3& p) const { return fmt::format("[{}, {}, {}]", p.x, p.y, p.z); }
  std::string operator()(std::chrono::year_month_day date) const { return sim::written(date); }
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(const RuleReference& reference) const { return reference.file; }
  std::string operator()(const Pairs& pairs) const {
    return listed(pairs, [](const glm::dvec2& p) { return fmt::format("[{}, {}]", p.x, p.y); });
  }
  std::string operator()(const Polygons& polygons) const {
    const std::string_view unit = polygons.metres ? " m" : "";
    const auto corner = [&](const sim::Vec3& p) {
      return fmt::format("[{1}{0}, {2}{0}, {3}{0}]", unit, p.x, p.y, p.z);
    };
    return listed(polygons.corners, [&](const auto& polygon) { return listed(polygon, corner); });
  }
  std::string operator()(const std::vector<std::string>& names) const {
    return listed(names, [](const std::string& name) { return name; });
  }

 private:
  template <class T, class One>
  static std::string listed(const std::vector<T>& list, One one) {
    std::string all;
    for (const auto& item : list) all += (all.empty() ? "" : ", ") + one(item);
    return list.empty() ? "" : "[" + all + "]";
  }
};

}  // namespace

const Key* find(const Table& table, std::string_view name) {
  for (const auto& key : table.keys) {
    if (key.name == name) return &key;
  }
  return nullptr;
}

const Key* briefOf(const Key& key) {
  return key.shorthand.empty() ? nullptr : find(*key.child, key.shorthand);
}

bool within(const Limits& limits, double number) {
  return (limits.above ? number > limits.min : number >= limits.min) && number <= limits.max;
}

std::string rangeText(const Limits& limits) {
  const bool below = std::isinf(limits.min), open = std::isinf(limits.max);
  if (below && open) return "";
  if (below) return fmt::format("at most {}", limits.max);
  if (limits.above)
    return fmt::format("more than {}", limits.min) + (open ? "" : fmt::format(", at most {}", limits.max));
  return open ? fmt::format("{} or more", limits.min) : fmt::format("{} to {}", limits.min, limits.max);
}

std::string expectation(const Key& key) {
  constexpr std::string_view kOrVaries =
      ", a range [a, b] of such, or a curve {over: exposure, age, height or a sense, points: [[x, y], ...]}";
  switch (key.kind) {
    case Kind::header:
      return "rules, rules/1, scene or scene/1";
    case Kind::flag:
      return "true or false";
    case Kind::whole:
      return bounded(key, "a whole number");
    case Kind::whole_range:
      return bounded(key, "a whole number") + ", or a range [a, b] of such";
    case Kind::number:
      return bounded(key, "a number");
    case Kind::value:
      return bounded(key, "a number").append(kOrVaries);
    case Kind::length:
      return bounded(key, "a length") + ", such as 2.4 or \"12 cm\"" + std::string(kOrVaries);
    case Kind::distance:
      return bounded(key, "a length") + ", such as 2.4 or \"12 cm\"";
    case Kind::size:
      return bounded(key, "a number") + ", or a length such as \"6 cm\"" + std::string(kOrVaries);
    case Kind::metres:
      return bounded(key, "a length") + ", such as 0.04 or \"4 cm\"";
    case Kind::colour:
      return "a colour such as \"#4f7a2c\" in quotes, or [r, g, b] with each from 0 to 1 (sRGB)";
    case Kind::point:
      return fmt::format("three numbers [x, y, z]{}", inUnit(key));
    case Kind::place:
      return fmt::format("a point [x, y, z]{}", inUnit(key));
    case Kind::pairs:
      return fmt::format("a list of 1 to {} pairs [a, b] of numbers, b {}", key.most, rangeText(key.limits));
    case Kind::outline:
      return fmt::format("a list of 1 to {} points [a, b]{}, b {}", key.most, inUnit(key),
                         rangeText(key.limits));
    case Kind::polygons:
      return fmt::format(
          "a list of polygons, each a list of points [x, y, z]{}, all numbers or all lengths such as \"2 "
          "cm\"",
          inUnit(key));
    case Kind::lines:
      return fmt::format("a list of lines, each a list of points [x, y, z]{}", inUnit(key));
    case Kind::choice:
      return fmt::format("one of {}", fmt::join(key.choices, ", "));
    case Kind::date:
      return fmt::format("a date such as 2026-06-21, or 06-21 (of {})", static_cast<int>(sim::kUsualYear));
    case Kind::name:
      return "a name of letters, digits, '_', '-' and '.', such as south_wall";
    case Kind::text:
      return key.most == 0 ? "a text on one line"
                           : fmt::format("a text on one line, of at most {} characters", key.most);
    case Kind::names:
      return "a list of names";
    case Kind::file:
      return "a path, relative to this file";
    case Kind::base:
      return "the path of a rule file, relative to this file, or the name of one of the library";
    case Kind::rules:
      return "the path of a rule file, the name of one of the library, or a mapping of rule keys";
    case Kind::regions:
      return fmt::format(
          "a mapping from region names (or {}) to 'forbid', {{rules: file.yaml}} or rule keys that "
          "differ there",
          kOthers);
    case Kind::section:
    case Kind::entries:
    case Kind::named:
      break;
  }
  std::vector<std::string> names;
  for (const auto& k : key.child->keys) names.push_back(k.name);
  auto mapping = fmt::format("a mapping with some of the keys {}", fmt::join(names, ", "));
  if (const Key* brief = briefOf(key)) mapping = fmt::format("{}, or {}", mapping, expectation(*brief));
  if (key.kind == Kind::named) return "a mapping from names, each to " + mapping;
  return key.kind == Kind::entries ? "a list, each entry " + mapping : mapping;
}

std::string written(const Datum& datum) {
  return std::visit(Writer{}, datum);
}

}  // namespace espalier::rules
