#include "scenes/yaml/yaml_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "rules/language/colour.h"
#include "scenes/yaml/yaml_scalar.h"

namespace espalier::scenes {
namespace {

using rules::Datum;
using rules::Distance;
using rules::Key;
using rules::Kind;
using rules::Length;
using rules::Polygons;
using rules::Value;
using rules::WholeRange;
using Node = YamlNode;
using Unit = WrittenLength::Unit;

constexpr std::size_t kMostCorners = 64;
constexpr std::size_t kMostPointsOfCurve = 256;

template <class T>
using Maybe = std::optional<T>;

/// Reads the lengths of one value, which are all plain numbers or all have units; where a plain 0 may be
/// either, as in a polygon's corner, it binds none of the others.
class LengthReader {
 public:
  explicit LengthReader(const ScalarReader& read)
      : read_(read), is_polygon_(read.key.kind == Kind::polygons) {}

  Maybe<double> next(const Node& node) {
    const auto length = read_.length(node);
    if (!length) return std::nullopt;
    if (length->unit == Unit::voxels && (is_polygon_ || read_.key.kind == Kind::size))
      return read_.fail(node,
                        fmt::format("is {}, in voxel widths, which are not written here", described(node)));
    if (is_polygon_ && length->unit == Unit::none && length->number == 0.0) return 0.0;
    const auto unit = length->unit == Unit::metres ? Unit::metres : Unit::voxels;
    if (unit_ != Unit::none && unit_ != unit) return mixed(node);
    unit_ = unit;
    return length->number;
  }
  bool metres() const { return unit_ == Unit::metres; }

 private:
  /// Said once: a polygon has many corners.
  std::nullopt_t mixed(const Node& node) {
    if (is_mixed_) return std::nullopt;
    is_mixed_ = is_polygon_;
    return read_.fail(node, fmt::format("has {} after a number in another unit", described(node)));
  }

  const ScalarReader& read_;
  bool is_polygon_;
  bool is_mixed_ = false;
  Unit unit_ = Unit::none;  ///< of the numbers so far
};

/// Reads a constant, a range or a curve, of plain numbers or of lengths.
class ValueReader {
 public:
  explicit ValueReader(const ScalarReader& read) : read_(read), lengths_(read) {}

  Maybe<Value> value(const Node& node) {
    if (node.kind == Node::Kind::list) return range(node);
    if (node.kind == Node::Kind::map) return curve(node);
    const auto constant = number(node);
    return constant ? Maybe<Value>(*constant) : std::nullopt;
  }
  bool metres() const { return lengths_.metres(); }

 private:
  Maybe<double> number(const Node& node) {
    return read_.key.kind == Kind::value ? read_.number(node) : lengths_.next(node);
  }

  Maybe<Value> range(const Node& node) {
    if (node.items.size() != 2) return read_.fail(node, fmt::format("is a list of {}", node.items.size()));
    const auto low = number(node.items[0]);
    const auto high = number(node.items[1]);
    if (!low || !high) return std::nullopt;
    if (*low > *high) return read_.fail(node, fmt::format("is a range from {} down to {}", *low, *high));
    Value value(*low);
    value.kind = Value::Kind::range;
    value.high = *high;
    return value;
  }

  Maybe<Value> curve(const Node& node) {
    Value value;
    value.kind = Value::Kind::curve;
    bool good = true;
    for (const auto& entry : node.entries) {
      if (entry.key == "over") {
        good = readOver(entry.value, value) && good;
      } else if (entry.key == "points") {
        good = readPoints(entry.value, value) && good;
      } else {
        read_.problems.add(entry.place,
                           fmt::format("unknown key {} in a curve; expected over and points{}",
                                       inQuotes(entry.key), didYouMean(entry.key, {"over", "points"})));
        good = false;
      }
    }
    for (const char* key : {"over", "points"}) {
      if (node.entry(key)) continue;
      read_.fail(node, fmt::format("is a mapping without '{}'", key));
      good = false;
    }
    return good ? Maybe<Value>(value) : std::nullopt;
  }

  bool readOver(const Node& node, Value& value) {
    if (node.kind != Node::Kind::scalar || node.text.empty()) {
      read_.say(node,
                fmt::format("{}.over is {}; expected exposure, age (iterations), height (metres) or the "
                            "name of a sense",
                            read_.path, described(node)));
      return false;
    }
    const auto axis = std::find(rules::kAxes.begin(), rules::kAxes.end(), node.text);
    value.over = static_cast<rules::Over>(axis - rules::kAxes.begin());
    // Whether the rule set has such a sense is known when all of it is.
    if (value.over == rules::Over::sense) value.sense = node.text;
    return true;
  }

  bool readPoints(const Node& node, Value& value) {
    if (node.kind != Node::Kind::list || node.items.size() < 2 || node.items.size() > kMostPointsOfCurve) {
      read_.say(node, fmt::format("{}.points is {}; expected a list of 2 to {} points [x, y]", read_.path,
                                  described(node), kMostPointsOfCurve));
      return false;
    }
    bool good = true;
    for (const auto& item : node.items) good = readPoint(item, value) && good;
    return good;
  }

  bool readPoint(const Node& node, Value& value) {
    if (node.kind != Node::Kind::list || node.items.size() != 2) {
      read_.say(node, fmt::format("{}.points has {}; expected points [x, y]", read_.path, described(node)));
      return false;
    }
    const auto x = read_.anyNumber(node.items[0]);
    const auto y = number(node.items[1]);
    if (!x || !y) return false;
    const bool rising = value.curve.empty() || value.curve.back().x < *x;
    if (!rising)
      read_.say(node, fmt::format("{}.points has x = {} after {}; expected x to rise", read_.path, *x,
                                  value.curve.back().x));
    value.curve.push_back({*x, *y});
    return rising;
  }

  const ScalarReader& read_;
  LengthReader lengths_;
};

/// Three numbers, each read by `one`.
template <class One>
Maybe<sim::Vec3> triple(const ScalarReader& read, const Node& node, One one) {
  if (node.kind != Node::Kind::list) return read.mismatch(node);
  if (node.items.size() != 3)
    return read.fail(node,
                     fmt::format("has a list of {} where three numbers should stand", node.items.size()));
  sim::Vec3 point{0.0};
  bool good = true;
  for (int i = 0; i < 3; ++i) {
    const auto& item = node.items[static_cast<std::size_t>(i)];
    const Maybe<double> number = one(item);
    good = good && number;
    point[i] = number.value_or(0.0);
  }
  return good ? Maybe<sim::Vec3>(point) : std::nullopt;
}

/// A list, every entry read by `one`; nothing if any of them is wrong, after all were looked at.
template <class One>
auto listOf(const ScalarReader& read, const Node& node, std::size_t most, One one)
    -> Maybe<std::vector<typename decltype(one(node))::value_type>> {
  if (node.kind != Node::Kind::list) return read.mismatch(node);
  if (node.items.size() > most)
    return read.fail(node, fmt::format("has a list of {}, more than {}", node.items.size(), most));
  using Entry = typename decltype(one(node))::value_type;
  const auto isScalar = [](const Node& item) { return item.kind == Node::Kind::scalar; };
  if constexpr (!std::is_same_v<Entry, std::string>) {
    // A level of brackets was forgotten: said once, not for every number.
    if (!node.items.empty() && std::all_of(node.items.begin(), node.items.end(), isScalar)) {
      return read.fail(node, "has a list of single values where a list of points should stand");
    }
  }
  std::vector<Entry> all;
  for (const auto& item : node.items) {
    if (auto entry = one(item)) all.push_back(std::move(*entry));
  }
  if (all.size() != node.items.size()) return std::nullopt;
  return all;
}

Maybe<sim::Colour> colour(const ScalarReader& read, const Node& node) {
  if (node.kind != Node::Kind::list) return read.hexColour(node);
  const auto srgb = triple(read, node, [&](const Node& n) { return read.number(n); });
  return srgb ? Maybe<sim::Colour>(rules::linearFromSrgb(sim::Colour(*srgb))) : std::nullopt;
}

Maybe<WholeRange> wholeRange(const ScalarReader& read, const Node& node) {
  if (node.kind == Node::Kind::scalar) {
    const auto one = read.whole(node);
    return one ? Maybe<WholeRange>(WholeRange{*one, *one}) : std::nullopt;
  }
  if (node.kind != Node::Kind::list) return read.mismatch(node);
  if (node.items.size() != 2) return read.fail(node, fmt::format("is a list of {}", node.items.size()));
  const auto low = read.whole(node.items[0]);
  const auto high = read.whole(node.items[1]);
  if (!low || !high) return std::nullopt;
  if (*low > *high) return read.fail(node, fmt::format("is a range from {} down to {}", *low, *high));
  return WholeRange{*low, *high};
}

template <class T>
Maybe<Datum> datum(Maybe<T> value) {
  return value ? Maybe<Datum>(Datum{std::move(*value)}) : std::nullopt;
}

Maybe<Datum> varying(const ScalarReader& read, const Node& node) {
  ValueReader reader(read);
  auto value = reader.value(node);
  if (!value) return std::nullopt;
  if (read.key.kind == Kind::value) return Datum{std::move(*value)};
  return Datum{Length{std::move(*value), reader.metres()}};
}

Maybe<Distance> distance(const ScalarReader& read, const Node& node) {
  LengthReader lengths(read);
  const auto number = lengths.next(node);
  return number ? Maybe<Distance>(Distance{*number, lengths.metres()}) : std::nullopt;
}

/// A list of pairs. The limits are of their second numbers; a first length may be as far to either side of 0.
Maybe<rules::Pairs> pairs(const ScalarReader& read, const Node& node) {
  const auto pair = [&](const Node& n) -> Maybe<glm::dvec2> {
    if (n.kind != Node::Kind::list || n.items.size() != 2)
      return read.fail(n, fmt::format("has {} where a pair [a, b] should stand", described(n)));
    const bool lengths = read.key.kind == Kind::outline;
    Key either = read.key;
    either.limits = {-read.key.limits.max, read.key.limits.max};
    const auto a = lengths ? ScalarReader{either, read.path, read.problems}.metres(n.items[0])
                           : read.anyNumber(n.items[0]);
    const auto b = lengths ? read.metres(n.items[1]) : read.number(n.items[1]);
    return a && b ? Maybe<glm::dvec2>(glm::dvec2(*a, *b)) : std::nullopt;
  };
  if (node.kind == Node::Kind::list && node.items.empty()) return read.fail(node, "is an empty list");
  return listOf(read, node, read.key.most, pair);
}

Maybe<Polygons> polygons(const ScalarReader& read, const Node& node) {
  LengthReader lengths(read);
  const auto corner = [&](const Node& n) {
    return triple(read, n, [&](const Node& c) { return lengths.next(c); });
  };
  const auto polygon = [&](const Node& n) { return listOf(read, n, kMostCorners, corner); };
  auto corners = listOf(read, node, read.key.most, polygon);
  return corners ? Maybe<Polygons>(Polygons{std::move(*corners), lengths.metres()}) : std::nullopt;
}

Maybe<Polygons> lines(const ScalarReader& read, const Node& node) {
  constexpr std::size_t kMostOfALine = 10'000;
  const auto place = [&](const Node& n) {
    return triple(read, n, [&](const Node& c) { return read.metres(c); });
  };
  const auto line = [&](const Node& n) -> Maybe<std::vector<sim::Vec3>> {
    if (n.kind == Node::Kind::list && n.items.empty()) return read.fail(n, "is an empty list");
    return listOf(read, n, kMostOfALine, place);
  };
  if (node.kind == Node::Kind::list && node.items.empty()) return read.fail(node, "is an empty list");
  auto found = listOf(read, node, read.key.most, line);
  return found ? Maybe<Polygons>(Polygons{std::move(*found), true}) : std::nullopt;
}

}  // namespace

std::optional<Datum> readDatum(const Node& node, const Key& key, const std::string& path,
                               Problems& problems) {
  if (node.refused) return std::nullopt;
  const ScalarReader read{key, path, problems};
  const auto number = [&](const Node& n) { return read.number(n); };
  const auto metres = [&](const Node& n) { return read.metres(n); };
  const auto name = [&](const Node& n) { return read.name(n); };
  switch (key.kind) {
    case Kind::flag:
      return datum(read.flag(node));
    case Kind::whole:
      return datum(read.whole(node));
    case Kind::whole_range:
      return datum(wholeRange(read, node));
    case Kind::number:
      return datum(read.number(node));
    case Kind::value:
    case Kind::length:
    case Kind::size:
      return varying(read, node);
    case Kind::distance:
      return datum(distance(read, node));
    case Kind::metres:
      return datum(read.metres(node));
    case Kind::colour:
      return datum(colour(read, node));
    case Kind::point:
      return datum(triple(read, node, number));
    case Kind::place:
      return datum(triple(read, node, metres));
    case Kind::pairs:
    case Kind::outline:
      return datum(pairs(read, node));
    case Kind::polygons:
      return datum(polygons(read, node));
    case Kind::lines:
      return datum(lines(read, node));
    case Kind::choice:
      return datum(read.choice(node));
    case Kind::date:
      return datum(read.date(node));
    case Kind::name:
      return datum(read.name(node));
    case Kind::text:
    case Kind::file:
      return datum(read.text(node));
    case Kind::names:
      return datum(listOf(read, node, kMaxNodes, name));
    case Kind::header:
    case Kind::base:
    case Kind::rules:
    case Kind::regions:
    case Kind::section:
    case Kind::entries:
    case Kind::named:
      break;  // not read here
  }
  return std::nullopt;
}

}  // namespace espalier::scenes
