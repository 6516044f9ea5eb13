#include "scenes/read/reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rules/language/registry.h"
#include "scenes/read/read_table.h"
#include "scenes/read/registry.h"

namespace espalier::scenes {
namespace {

using rules::Key;
using rules::Kind;
using rules::Table;

const char* const kRuleWords = R"(# Rule files: every key

A rule file tells one kind of plant how to grow. It begins with `espalier: rules`; every other key may be left out.
**bias** bends each trial, **require** rejects those that do not meet it, **prefer** picks among the survivors.

How values are written:

- *number*: decimal, such as `2.4` or `.5`. No units, no leading zeros.
- *value*: a number; or a range `[a, b]`, from which every use draws evenly; or a curve
  `{over: exposure, points: [[0.3, 1], [1, 1.8]]}`, straight between its points and level beyond them. `over` is
  `exposure` (0 to 1), `age` (iterations since the plant was seeded), `height` (metres above the world's floor)
  or a sense of the rule set by its name (what it reads).
- *distance*: a number of voxel widths; or text with a unit, `12 cm`, `0.12 m`, `120 mm`, which stays the same when the
  voxels change. `2.4 vx` is `2.4`.
- *length*: a value of such; all of a range's or a curve's numbers have units, or none has.
- *size*: a value that is a factor; or lengths with units, `6 cm`, `[4 cm, 8 cm]`, each of which is then as long as 1 in
  the polygons.
- *pairs*: a list of `[a, b]`, such as `[[0, 1], [0.5, 3]]`.
- *polygons*: lists of corners `[x, y, z]`, all of an element's in voxel widths or all with units, `[0, 6 cm, -5 mm]`; 0
  needs none.
- *colour*: `"#4f7a2c"`, in quotes, for an unquoted `#` begins a comment; or `[r, g, b]` from 0 to 1. Both sRGB.
- *rule set*: a rule file's path, relative to this file; the name of one of the library (`espalier rules` lists them); or
  a mapping of keys that change the rule set around it.

`base: other.yaml` builds on another file, `base: ivy` on a rule set of the library: whatever is not said here is as it is there. Lists (`elements`) are replaced
as a whole, regions one by one.

`regions` maps the names of the scene's regions to `forbid`, to a rule set's file or name, to `{rules: file.yaml}`, or to keys
that differ there: `regions: {wall: {bias: {up: 0.2}}, others: forbid}`. `others` stands for every region that is not
named. A region that a scene does not have is a warning when something grows there.

The last column has the name in Ned Greene's *Voxel Space Automata* (SIGGRAPH 1989), where the paper has one.
)";

const char* const kSceneWords = R"(# Scene files: every key

A scene file names the meshes of a world, how they become voxels, what grows there, and the pictures wanted. It begins
with `espalier: scene`. Positions are in world space: metres, right-handed, y up. Paths are relative to the file.

How values are written:

- *number*: decimal, such as `2.4` or `.5`. No leading zeros.
- *length*: metres, as a number or as text with a unit: `0.04`, `4 cm`, `40 mm`, `0.04 m`.
- *point*: `[x, y, z]`; *place*: the same in lengths.
- *pairs*: a list of `[a, b]`, such as `[[0, 1], [0.5, 3]]`; *outline*: the same in lengths, `[[0, 6 m], [2 m, 6 m]]`.
- *lines*: a list of lines, each a list of places from one end to the other.
- *colour*: `"#a05f46"`, in quotes, for an unquoted `#` begins a comment; or `[r, g, b]` from 0 to 1. Both sRGB.
- *date*: `2026-06-21`; or `06-21`, of 2017, the year of the common tables of the sun.
- *name*: letters, digits, `_`, `-` and `.`: it may become part of a file's name.
- *rule set*: a rule file's path; the name of one of the library (`espalier rules` lists them); or a mapping of the keys
  of one (see the page of rule files).

`world` needs either a voxel size or a resolution. An entry of `meshes` has a file or lines, and may be just a path; one of `images` just its
kind, one of `seeds` just its place.
`sun` is an inclined arc, or with `place` a real sun on a date or a range of dates.
)";

std::string kindText(const Key& key) {
  switch (key.kind) {
    case Kind::header:
      return "word";
    case Kind::flag:
      return "true or false";
    case Kind::whole:
      return "whole number";
    case Kind::whole_range:
      return "whole number or range";
    case Kind::number:
      return "number";
    case Kind::value:
      return "value";
    case Kind::length:
    case Kind::metres:
      return "length";
    case Kind::distance:
      return "distance";
    case Kind::size:
      return "size";
    case Kind::colour:
      return "colour";
    case Kind::point:
      return "point";
    case Kind::place:
      return "place";
    case Kind::pairs:
      return "pairs";
    case Kind::outline:
      return "outline";
    case Kind::polygons:
      return "polygons";
    case Kind::lines:
      return "lines";
    case Kind::choice:
      return fmt::format("`{}`", fmt::join(key.choices, "`, `"));
    case Kind::date:
      return "date";
    case Kind::name:
      return "name";
    case Kind::text:
      return "text";
    case Kind::names:
      return "list of names";
    case Kind::file:
    case Kind::base:
      return "path";
    case Kind::rules:
      return "rule set";
    case Kind::regions:
      return "mapping of regions";
    case Kind::section:
      return "mapping";
    case Kind::entries:
      return "list of mappings";
    case Kind::named:
      return "mapping of names to mappings";
  }
  return "";
}

std::string defaultText(const Key& key) {
  if (key.required) return "required";
  const auto text = rules::written(key.default_value);
  return text.empty() ? "" : "`" + text + "`";
}

std::string rangeOf(const Key& key) {
  const bool has_numbers = key.kind != Kind::colour && key.kind != Kind::section;
  auto text = has_numbers ? rules::rangeText(key.limits) : "";
  if (key.most > 0) {
    text += fmt::format("{}at most {} {}", text.empty() ? "" : "; ", key.most,
                        key.kind == Kind::text ? "characters" : "entries");
  }
  return text;
}

}  // namespace

std::string referenceFor(FileKind kind) {
  const bool is_rules = kind == FileKind::rules;
  std::string page = is_rules ? kRuleWords : kSceneWords;
  page += "\nThis page is made from the program's own registry of keys.\n\n";
  page += is_rules
              ? "| key | value | unit | default | range | meaning | Greene |\n| --- | --- | --- | --- | --- "
                "| --- | --- |\n"
              : "| key | value | unit | default | range | meaning |\n| --- | --- | --- | --- | --- | --- |\n";
  forEachKey(is_rules ? rules::ruleTable() : sceneTable(), [&](const std::string& path, const Key& key) {
    page += fmt::format("| `{}` | {} | {} | {} | {} | {} |", path, kindText(key), key.unit, defaultText(key),
                        rangeOf(key), key.meaning);
    if (is_rules) page += key.greene.empty() ? "  |" : fmt::format(" `{}` |", key.greene);
    page += "\n";
  });
  return page;
}

}  // namespace espalier::scenes
