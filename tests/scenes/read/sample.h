#pragma once
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "rules/language/key.h"

/// Values for any key of a registry, made from what the registry says of it: so that a new key is tested as
/// soon as it stands there.
namespace espalier::tests {

/// So far into a key's limits.
inline double numberAt(const rules::Key& key, double fraction) {
  const double low = std::max(key.limits.min, -10.0),
               high = std::min(key.limits.max, 10.0 + std::max(0.0, low));
  return low + (high - low) * fraction;
}
/// Well inside the limits, and not the default.
inline double goodNumber(const rules::Key& key) {
  return numberAt(key, key.name == "max" ? 0.75 : 0.25);
}
/// Another one.
inline double otherNumber(const rules::Key& key) {
  return numberAt(key, key.name == "max" ? 0.9 : 0.4);
}
inline std::string goodWhole(const rules::Key& key) {
  return fmt::format("{}", static_cast<long>(std::ceil(goodNumber(key))));
}

std::string goodMapping(const rules::Table& table);

inline std::vector<std::string> goodTexts(const rules::Key& key);

/// And what a value that is no mapping may be, each put in place of {} in `around`.
inline std::vector<std::string> withBrief(std::vector<std::string> texts, const rules::Key& key,
                                          const char* around) {
  if (const auto* brief = rules::briefOf(key)) {
    for (const auto& text : goodTexts(*brief)) texts.push_back(fmt::format(fmt::runtime(around), text));
  }
  return texts;
}

/// Texts that a file may have for a key.
inline std::vector<std::string> goodTexts(const rules::Key& key) {
  using rules::Kind;
  const auto number = fmt::format("{}", goodNumber(key));
  const auto other = fmt::format("{}", otherNumber(key));
  const auto range = fmt::format("[{0}, {0}]", number);
  const auto curve = fmt::format("{{over: exposure, points: [[0, {0}], [1, {0}]]}}", number);
  const auto triple = fmt::format("[{0}, {0}, {0}]", number);
  switch (key.kind) {
    case Kind::header:
      return {};
    case Kind::flag:
      return {"true", "false"};
    case Kind::whole:
      return {goodWhole(key), fmt::format("{}", static_cast<long>(std::ceil(otherNumber(key))))};
    case Kind::whole_range:
      return {fmt::format("[{0}, {0}]", goodWhole(key)), goodWhole(key),
              fmt::format("[{}, {}]", goodWhole(key), static_cast<long>(std::ceil(otherNumber(key))))};
    case Kind::number:
      return {number, other};
    case Kind::value:
      return {number, range, curve};
    case Kind::length:
      return {number, range, curve, "\"3 cm\"", "[3 mm, 4 mm]", "2 vx"};
    case Kind::distance:
      return {number, other, "\"3 cm\"", "40 mm", "2 vx"};
    case Kind::size:
      return {number,     range,          curve,
              "\"3 cm\"", "[3 mm, 4 mm]", "{over: age, points: [[0, 2 cm], [9, 0.05 m]]}"};
    case Kind::metres:
      return {number, "30 cm", "\"250 mm\""};
    case Kind::colour:
      return {"\"#4f7a2c\"", "[0.1, 0.2, 1]"};
    case Kind::point:
      return {triple, fmt::format("[{0}, {1}, {0}]", number, other)};
    case Kind::place:
      return {triple, "[1 cm, 2 mm, 0.1 m]"};
    case Kind::pairs:
      return {fmt::format("[[0, {}], [0.5, {}], [1, {}]]", number, other, number)};
    case Kind::outline:
      if (key.most == 2) return {fmt::format("[[0, {0}], [1, 0.5]]", number), "[[0, 1 cm], [1 mm, 2 m]]"};
      return {fmt::format("[[0, {0}], [1, {0}], [2, {0}], [3, {0}]]", number),
              "[[0, 1 cm], [1 mm, 2 mm], [0.5 m, 0.1 m], [1, 1]]"};
    case Kind::polygons:
      return {"[[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]", "[[[0, 0, 0], [1, 0, 0], [0, 1, 0.5]]]",
              "[[[0, 0, 0], [1 cm, 0, 0], [0, 20 mm, \"-1 mm\"]]]"};
    case Kind::lines:
      return {"[[[0, 0, 0], [1, 0, 0]]]", "[[[0, 0, 0]], [[1 cm, 0, 0], [0, 20 mm, 1 m], [1, 1, 1]]]"};
    case Kind::choice:
      return key.choices;
    case Kind::date:
      return {"2026-06-21", "02-28", "\"2024-02-29\""};
    case Kind::name:
      return {"some_name-1.x", "other"};
    case Kind::text:
      return {"\"a text: of any kind\"", "word"};
    case Kind::names:
      return {"[a, b]", "[]"};
    case Kind::file:
      return {"mesh.obj", "sub/mesh.obj"};
    case Kind::base:
      return {"other.yaml", "ivy"};
    case Kind::rules:
      return {"other.yaml", "ivy", "{name: x}", "{base: ivy}", "{}"};
    case Kind::regions:
      return {"{a: forbid, b: other.yaml, c: {rules: ivy}, d: {name: x}, e: ivy}", "{others: forbid}", "{}"};
    case Kind::section:
      return withBrief({goodMapping(*key.child)}, key, "{}");
    case Kind::entries:
      return withBrief({fmt::format("[{}]", goodMapping(*key.child)), "[]"}, key, "[{}]");
    case Kind::named:
      return {fmt::format("{{some: {}}}", goodMapping(*key.child))};
  }
  return {};
}

/// Whether a mapping needs a key: one that must be there, or the first of those of which one must.
inline bool needed(const rules::Table& table, const rules::Key& key) {
  return key.required || (!table.one_of.empty() && table.one_of.front() == key.name);
}

inline std::string goodMapping(const rules::Table& table) {
  std::string all;
  for (const auto& key : table.keys) {
    if (needed(table, key))
      all += fmt::format("{}{}: {}", all.empty() ? "" : ", ", key.name, goodTexts(key).front());
  }
  return fmt::format("{{{}}}", all);
}

/// Texts that a file must not have for a key; each is outside its range or of another type.
inline std::vector<std::string> badTexts(const rules::Key& key) {
  using rules::Kind;
  const auto beyond = [&](auto wrap) {
    std::vector<std::string> texts;
    if (std::isfinite(key.limits.max))
      texts.push_back(wrap(fmt::format("{:.17g}", key.limits.max + std::max(1.0, key.limits.max / 1024))));
    if (std::isfinite(key.limits.min))
      texts.push_back(wrap(fmt::format("{:.17g}", key.limits.above ? key.limits.min : key.limits.min - 1)));
    texts.push_back(wrap("few"));
    texts.push_back(wrap("{}"));
    return texts;
  };
  const auto plain = [](const std::string& text) { return text; };
  const auto triple = [](const std::string& text) { return fmt::format("[{0}, {0}, {0}]", text); };
  const auto more = [](std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  switch (key.kind) {
    case Kind::header:
      return {"tree", "rules/2", "[rules]"};
    case Kind::flag:
      return {"yes", "1", "\"true\"", "[]", "{}"};
    case Kind::whole:
      return more(beyond(plain), {"1.5", "[]", "true"});
    case Kind::number:
      return more(beyond(plain), {"[1, 2]", "\"1\"", "true", "0x1", "007"});
    case Kind::whole_range:
      return more(beyond(plain), {"[3]", "[5, 4]", "1.5"});
    case Kind::value:
      return more(beyond(plain),
                  {"[1]", "[0.5, 0.25]", "true", "\"1\"", "{over: [x], points: [[0, 0.5], [1, 0.5]]}",
                   "{over: age, points: [[0, 0.5]]}"});
    case Kind::length:
      return more(beyond(plain), {"3 yards", "[4 mm, 3 mm]", "[1 vx, 1 m]", "-1 cm", "true"});
    case Kind::distance:
      return more(beyond(plain), {"3 yards", "5 kg", "12 cmm", "\"1\"", "[1, 2]", "-1 cm", "true"});
    case Kind::size:
      return more(beyond(plain), {"3 yards", "[4 mm, 3 mm]", "[1, 1 m]", "2 vx", "-1 cm", "true"});
    case Kind::metres:
      return more(beyond(plain), {"3 yards", "3 vx", "[]"});
    case Kind::colour:
      return {"green", "\"#12345\"", "[1, 2]", "[2, 0, 0]", "{}", "5"};
    case Kind::point:
      return more(beyond(triple), {"[1, 2]", "1", "{}"});
    case Kind::place:
      return more(beyond(triple), {"[1, 2]", "1", "[1 vx, 0, 0]"});
    case Kind::pairs:
    case Kind::outline:
      return more(beyond([](const std::string& text) { return fmt::format("[[0, {}]]", text); }),
                  {"[]", "[1, 2]", "[[1]]", "[[1, 2, 3]]", "[[few, 1]]", "1", "{}"});
    case Kind::polygons:
      return {"[[0, 0, 0]]", "1", "[[[0, 0, few], [1, 0, 0], [0, 1, 0]]]",
              "[[[0, 0, 0], [1 cm, 0, 0], [0, 2, 0]]]", "[[[0, 0, 0], [1 vx, 0, 0], [0, 1, 0]]]"};
    case Kind::lines:
      return {"[]", "[[]]", "[[0, 0, 0]]", "1", "[[[0, 0, few], [1, 0, 0]]]", "[[[1 vx, 0, 0]]]"};
    case Kind::choice:
      return {"none_of_them", "5", "[]", "{}"};
    case Kind::date:
      return {"2026-02-30", "02-29", "2026-13-01", "2026-6-21", "21.06.2026", "2026-06",
              "-026-06-21", "0621",  "5",          "[]",        "{}"};
    case Kind::name:
      return {"a/b", ".a", "\"\"", "[]", "{}", "\"a b\""};
    case Kind::names:
      return {"a", "[a/b]", "{}", "[[a]]"};
    case Kind::text:
    case Kind::file:
      return {"\"\"", "[]", "{}"};
    case Kind::base:
      return {"[]", "{}", "\"\"", "none.yaml"};
    case Kind::rules:
      return {"[]", "\"\"", "none.yaml", "{nmae: x}"};
    case Kind::regions:
      return {"[]",
              "x",
              "{a: forbiden}",
              "{a: []}",
              "{a: {nmae: x}}",
              "{a: {rules: {}, name: x}}",
              "{others: {nmae: x}}"};
    case Kind::section: {
      const auto* const brief = rules::briefOf(key);
      const bool any_text = brief != nullptr && (brief->kind == Kind::file || brief->kind == Kind::text);
      return {"[[]]", "{unknown_key: 1}", any_text ? "\"\"" : "few_words"};
    }
    case Kind::entries:
      return {"{}", "few_words", "[{unknown_key: 1}]", "[[]]"};
    case Kind::named:
      return {"[]", "few_words", "{a: {unknown_key: 1}}", rules::briefOf(key) ? "{a: [true]}" : "{a: 5}"};
  }
  return {};
}

/// Walks a registry's keys; `wrap` puts a key and its value into whole mappings, with whatever else is
/// required.
inline void forEachKeyInPlace(
    const rules::Table& table, const std::string& path,
    const std::function<std::string(const std::string&)>& wrap,
    const std::function<void(const std::string& path, const rules::Key&,
                             const std::function<std::string(const std::string&)>&)>& visit) {
  for (const auto& key : table.keys) {
    std::string others;
    for (const auto& other : table.keys) {
      if (needed(table, other) && other.name != key.name)
        others += fmt::format(", {}: {}", other.name, goodTexts(other).front());
    }
    const auto here = [=](const std::string& value) {
      return wrap(fmt::format("{{{}: {}{}}}", key.name, value, others));
    };
    visit(path + key.name, key, here);
    using rules::Kind;
    if (key.kind == Kind::section) forEachKeyInPlace(*key.child, path + key.name + ".", here, visit);
    if (key.kind == Kind::entries) {
      forEachKeyInPlace(
          *key.child, path + key.name + "[].",
          [=](const std::string& v) { return here(fmt::format("[{}]", v)); }, visit);
    }
    if (key.kind == Kind::named) {
      forEachKeyInPlace(
          *key.child, path + key.name + ".some.",
          [=](const std::string& v) { return here(fmt::format("{{some: {}}}", v)); }, visit);
    }
  }
}

}  // namespace espalier::tests
