#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rules/language/rule_set.h"
#include "rules/language/value.h"
#include "sim/base/vec.h"

/// The machinery of a registry: descriptions of the keys of a file and how each finds its field in a plain
/// struct. It knows no file format. Readers, schemas and reference pages walk a Table; nothing else says what
/// a key is.
namespace espalier::rules {

/// What a key's value looks like in a file.
enum class Kind {
  header,       ///< the kind of file
  flag,         ///< true or false
  whole,        ///< a whole number
  whole_range,  ///< a whole number or [a, b]
  number,       ///< a number
  value,        ///< Value: a constant, a range or a curve
  length,       ///< Length: voxel widths, or text such as "12 cm"; also ranges and curves of those
  distance,     ///< Distance: voxel widths, or text such as "12 cm"
  size,         ///< Length: a factor, or text such as "12 cm"; also ranges and curves of those
  metres,       ///< a number of metres or text such as "4 cm"
  colour,       ///< "#rrggbb" or [r, g, b], both sRGB; stored linear
  point,        ///< [x, y, z] of numbers
  place,        ///< [x, y, z], each as in `metres`
  pairs,        ///< Pairs: a list of [a, b], both numbers; the limits are of b
  outline,      ///< Pairs: the same, each number as in `metres`
  polygons,     ///< Polygons: a list of them, each a list of points [x, y, z], each as in `distance`
  lines,        ///< Polygons, in metres: a list of lines, each a list of places
  choice,       ///< one of a few words
  name,         ///< a word that may become part of a file name
  text,         ///< any text of one line
  names,        ///< a list of names
  date,         ///< a day: 2026-06-21; or 06-21, of the year sim::kUsualYear
  file,         ///< a path, relative to the file that names it
  base,         ///< the file of a rule set to build on
  rules,        ///< a rule set: its file, or a mapping of rule keys
  regions,      ///< of a RuleSet: a mapping from region names and kOthers to rule sets, or the word forbid
  section,      ///< a mapping with keys of its own
  entries,      ///< a list of such mappings
  named         ///< a mapping from names to such mappings
};

/// Among the names of Kind::regions: every region that is not named.
inline constexpr const char* kOthers = "others";

/// Bounds of a number; of each number of a range, a curve or a point.
struct Limits {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool above = false;  ///< min itself is refused
};

struct WholeRange {
  std::int64_t low = 0, high = 0;
  friend bool operator==(const WholeRange&, const WholeRange&) = default;
};

/// Points of a curve in the plane.
using Pairs = std::vector<glm::dvec2>;

/// A rule set that a file refers to; `file` is empty where it is written in place.
struct RuleReference {
  std::string file;
  std::shared_ptr<const RuleSet> rules;
  friend bool operator==(const RuleReference&, const RuleReference&) = default;
};

/// A value on its way between a file and a struct. monostate: none.
using Datum = std::variant<std::monostate, bool, std::int64_t, WholeRange, double, Value, Length, Distance,
                           sim::Colour, sim::Vec3, std::chrono::year_month_day, std::string, Pairs, Polygons,
                           std::vector<std::string>, RuleReference>;

struct Table;

/// One of several structs of a key.
struct Item {
  std::string name;  ///< of Kind::named
  const void* object = nullptr;
};

/// One key. The functions take the struct that the key's table describes; which of them are there depends on
/// kind.
struct Key {
  std::string name;
  Kind kind = Kind::flag;
  std::string unit;  ///< empty for a plain number
  Limits limits;
  std::string meaning;  ///< one line
  std::string greene;   ///< Greene's own name for it (Voxel Space Automata, 1989, figure 4), if he has one
  bool required = false;
  std::size_t most = 0;  ///< entries of a list, characters of a text; 0: as many as the file holds
  std::vector<std::string> choices;
  std::string shorthand;  ///< sections and entries: the key that a value which is no mapping stands for
  std::shared_ptr<const Table> child;  ///< section, entries, named
  Datum default_value;

  std::function<void(void*, const Datum&)> set;
  std::function<Datum(const void*)> get;
  std::function<void*(void*)> open;  ///< section: the struct that its keys describe
  std::function<const void*(const void*)>
      look;  ///< section: the same; null where an optional one is not there
  std::function<std::vector<Item>(const void*)> items;     ///< entries, named: those that there are, in order
  std::function<void(void*)> clear;                        ///< entries, named: forget all
  std::function<void*(void*, const std::string&)> append;  ///< entries, named: a new one, by its name
};

/// A mapping's keys and the struct that they fill.
struct Table {
  std::vector<Key> keys;
  std::vector<std::string> one_of;  ///< keys of which at least one must be there; empty: none need be
  std::function<std::shared_ptr<void>()> make;  ///< a struct with every default
};

const Key* find(const Table& table, std::string_view name);

/// The key that a value which is no mapping stands for, or null.
const Key* briefOf(const Key& key);

/// Something that must hold between keys.
struct Check {
  /// Which of the files that build on each other wrote this key last, from 1; 0: none did.
  using Given = std::function<int(std::string_view path)>;
  /// A name that means nothing, and those that are known: whoever tells of it may say which was meant.
  struct Misnamed {
    std::string name;
    std::vector<std::string> known;
  };
  struct Complain {
    std::function<void(const std::string& path, const std::string& text, const Misnamed&)> say;
    void operator()(const std::string& path, const std::string& text, const Misnamed& name = {}) const {
      say(path, text, name);
    }
  };

  std::vector<std::string> reads;  ///< paths; the check waits where one of these is wrong by itself
  std::function<void(const void*, const Given&, const Complain&)> run;
};

bool within(const Limits& limits, double number);
/// "0 to 1", "more than 0, at most 100"; empty without bounds.
std::string rangeText(const Limits& limits);
/// "a number from 0 to 180 (degrees), a range [a, b] of them, ...": what a reader expects here.
std::string expectation(const Key& key);
/// A datum as it would stand in a file; empty for none.
std::string written(const Datum& datum);

}  // namespace espalier::rules
