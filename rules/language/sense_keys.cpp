#include "rules/language/sense_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "rules/language/key_builder.h"
#include "rules/language/registry.h"

namespace espalier::rules {
namespace {

constexpr std::array kOwnAxes{"exposure", "age", "height"};  // of curves

std::vector<std::string> namesOf(const std::vector<SenseSpec>& senses) {
  std::vector<std::string> names;
  for (const SenseSpec& sense : senses) names.push_back(sense.name);
  return names;
}

/// Calls visit(path, value) for all numbers of a struct that may be curves. Other rule sets that it leads to
/// have senses of their own.
void forEachValue(const Table& table, const void* object, const std::string& prefix,
                  const std::function<void(const std::string&, const Value&)>& visit) {
  if (object == nullptr) return;
  for (const Key& key : table.keys) {
    const std::string path = prefix + key.name;
    if (key.kind == Kind::section) {
      forEachValue(*key.child, key.look(object), path + ".", visit);
    } else if (key.kind == Kind::entries || key.kind == Kind::named) {
      const auto items = key.items(object);
      for (std::size_t i = 0; i < items.size(); ++i) {
        const auto at = key.kind == Kind::named ? "." + items[i].name : fmt::format("[{}]", i);
        forEachValue(*key.child, items[i].object, path + at + ".", visit);
      }
    } else if (key.kind == Kind::value || key.kind == Kind::length || key.kind == Kind::size) {
      const Datum datum = key.get(object);
      if (const auto* value = std::get_if<Value>(&datum)) visit(path, *value);
      if (const auto* length = std::get_if<Length>(&datum)) visit(path, length->value);
    }
  }
}

}  // namespace

std::shared_ptr<const Table> senseKeys() {
  return TableOf<SenseSpec>()
      .choice<SenseSpec::Measure>(
          "measure", &SenseSpec::measure,
          {{"density", SenseSpec::Measure::density},
           {"distance", SenseSpec::Measure::distance},
           {"height", SenseSpec::Measure::height}},
          {.meaning =
               "density: share of the voxels within, 0 to 1; distance: to the nearest, metres; height: "
               "above the next below, metres."})
      .text("of", &SenseSpec::of,
            {.meaning =
                 "Whose voxels: everything, scene, plants, own, others (other plants), or a region's name.",
             .most = 100})
      .distance("within", &SenseSpec::within,
                {.unit = "voxel widths", .limits = {0.0, 64.0, true}, .meaning = "How far it is looked for."})
      .shared();
}

std::shared_ptr<const Table> senseBiasKeys() {
  return TableOf<SenseBias>()
      .value("amount", &SenseBias::amount,
             {.unit = "weight",
              .limits = {-1.0, 1.0},
              .meaning = "How far it bends to the centre of mass (density), to the nearest (distance) or "
                         "down (height); below 0 away from there."})
      .shared();
}

std::shared_ptr<const Table> senseBoundsKeys() {
  return TableOf<SenseBounds>()
      .number("min", &SenseBounds::min,
              {.unit = "reading", .limits = {-1e6, 1e6}, .meaning = "A tip that reads less does not grow."})
      .number("max", &SenseBounds::max,
              {.unit = "reading", .limits = {-1e6, 1e6}, .meaning = "A tip that reads more does not grow."})
      .shared();
}

std::shared_ptr<const Table> sensePreferenceKeys() {
  return TableOf<SensePreference>()
      .number("at", &SensePreference::at,
              {.unit = "reading",
               .limits = {-1e6, 1e6},
               .meaning = "The trial at whose end the reading is nearest to this is preferred."})
      .number("weight", &SensePreference::weight,
              {.unit = "weight",
               .limits = {0.0, 1e6, true},
               .meaning = "What a reading that is 1 off counts, beside what else is preferred."})
      .shared();
}

void checkSenses(const RuleSet& rules, const Check::Given&, const Check::Complain& complain) {
  const std::vector<std::string> names = namesOf(rules.senses);
  const auto known = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const std::string have = names.empty() ? "senses: {" + std::string("NAME: ...}")
                                         : fmt::format("one of {}", fmt::join(names, ", "));
  const auto require = [&](const std::string& path, const auto& uses) {
    for (const auto& use : uses) {
      if (!known(use.name))
        complain(path + "." + use.name,
                 fmt::format("the rule set has no sense '{}'; expected {}", use.name, have));
    }
  };
  require("bias.senses", rules.bias.senses);
  require("require.senses", rules.require.senses);
  require("prefer.senses", rules.prefer.senses);
  for (const SenseSpec& sense : rules.senses) {
    if (std::find(kOwnAxes.begin(), kOwnAxes.end(), sense.name) != kOwnAxes.end())
      complain(
          "senses." + sense.name,
          fmt::format("a sense named '{}', which curves have already; expected another name", sense.name));
  }
  for (const SenseBounds& bounds : rules.require.senses) {
    if (bounds.min > bounds.max)
      complain("require.senses." + bounds.name,
               fmt::format("min is {} and max is {}; expected the first to be at most the second", bounds.min,
                           bounds.max));
  }
  forEachValue(ruleTable(), &rules, "", [&](const std::string& path, const Value& value) {
    if (value.kind != Value::Kind::curve || value.over != Over::sense || known(value.sense)) return;
    complain(path,
             fmt::format("a curve over '{}'; expected exposure, age (iterations), height (metres) or a "
                         "sense of this rule set{}",
                         value.sense, names.empty() ? "" : fmt::format(": {}", fmt::join(names, ", "))));
  });
}

}  // namespace espalier::rules
