#include "rules/language/sense_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "rules/language/key_builder.h"
#include "rules/language/rule_values.h"

namespace espalier::rules {
namespace {

std::vector<std::string> namesOf(const std::vector<SenseSpec>& senses) {
  std::vector<std::string> names;
  for (const SenseSpec& sense : senses) names.push_back(sense.name);
  return names;
}

void checkSense(const SenseSpec& sense, const Check::Given& given, const Check::Complain& complain) {
  const std::string at = "senses." + sense.name;
  if (std::find(kAxes.begin(), kAxes.end(), sense.name) != kAxes.end())
    complain(at,
             fmt::format("a sense named '{}', which curves have already; expected another name", sense.name));
  if (sense.measure == SenseSpec::Measure::height && given(at + ".within") > 0)
    complain(at + ".within",
             "within says nothing of a height, which goes all the way down; expected it gone");
  const bool holds_own = sense.of == "everything" || sense.of == "plants" || sense.of == "own";
  if (sense.measure == SenseSpec::Measure::distance && holds_own)
    complain(at + (given(at + ".of") > 0 ? ".of" : ".measure"),
             fmt::format("the distance to {} is none, as a plant touches itself; expected others, scene or a "
                         "region",
                         sense.of));
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

void checkSenses(const RuleSet& rules, const Check::Given& given, const Check::Complain& complain) {
  const std::vector<std::string> names = namesOf(rules.senses);
  const auto known = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const std::string have =
      names.empty() ? "senses: {NAME: ...}" : fmt::format("one of {}", fmt::join(names, ", "));
  const auto require = [&](const std::string& path, const auto& uses) {
    for (const auto& use : uses) {
      if (!known(use.name))
        complain(path + "." + use.name,
                 fmt::format("the rule set has no sense '{}'; expected {}", use.name, have),
                 {use.name, names});
    }
  };
  require("bias.senses", rules.bias.senses);
  require("require.senses", rules.require.senses);
  require("prefer.senses", rules.prefer.senses);
  for (const SenseSpec& sense : rules.senses) checkSense(sense, given, complain);
  for (const SenseBounds& bounds : rules.require.senses) {
    if (bounds.min > bounds.max)
      complain("require.senses." + bounds.name,
               fmt::format("min is {} and max is {}; expected the first to be at most the second", bounds.min,
                           bounds.max));
  }
  forEachValue(rules, [&](const std::string& path, const Value& value) {
    if (value.kind != Value::Kind::curve || value.over != Over::sense || known(value.sense)) return;
    std::vector<std::string> over(kAxes.begin(), kAxes.end());
    over.insert(over.end(), names.begin(), names.end());
    complain(
        path + ".over",
        fmt::format("{}.over is '{}'; expected exposure, age (iterations), height (metres) or a sense of "
                    "this rule set{}",
                    path, value.sense, names.empty() ? "" : fmt::format(": {}", fmt::join(names, ", "))),
        {value.sense, over});
  });
}

}  // namespace espalier::rules
