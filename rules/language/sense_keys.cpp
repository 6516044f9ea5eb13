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
  const bool of_nearest =
      sense.measure == SenseSpec::Measure::distance || sense.measure == SenseSpec::Measure::nearness;
  if ((sense.of == kOfLines || sense.of == kOfSurfaces) && !of_nearest)
    complain(at + ".of", fmt::format("{} are too thin for it; expected measure: distance or nearness, or the "
                                     "voxels of another",
                                     sense.of));
  const bool holds_own = sense.of == "everything" || sense.of == "plants" || sense.of == "own";
  if (of_nearest && holds_own)
    complain(
        at + (given(at + ".of") > 0 ? ".of" : ".measure"),
        fmt::format(
            "the distance to {} is none, as a plant touches itself; expected others, scene, lines, surfaces "
            "or a region",
            sense.of));
}

}  // namespace

std::shared_ptr<const Table> senseKeys() {
  return TableOf<SenseSpec>()
      .choice<SenseSpec::Measure>(
          "measure", &SenseSpec::measure,
          {{"density", SenseSpec::Measure::density},
           {"distance", SenseSpec::Measure::distance},
           {"nearness", SenseSpec::Measure::nearness},
           {"height", SenseSpec::Measure::height}},
          {.meaning =
               "Share of the voxels within, distance in metres, nearness (1 there, 0 from within on) or "
               "metres above."})
      .text("of", &SenseSpec::of,
            {.meaning = "Whose: everything, scene, plants, own, others, a region by its name; or lines or "
                        "surfaces, which are exact.",
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
              .meaning = "How far it bends to the centre of mass (density), the nearest or down (height); "
                         "below 0 away."})
      .shared();
}

std::shared_ptr<const Table> senseBoundsKeys() {
  return TableOf<SenseBounds>()
      .number("min", &SenseBounds::min,
              {.unit = "reading", .limits = {-1e6, 1e6}, .meaning = "What reads less is no place to grow."})
      .number("max", &SenseBounds::max,
              {.unit = "reading", .limits = {-1e6, 1e6}, .meaning = "What reads more is no place to grow."})
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
  require("require.along", rules.require.along);
  require("prefer.senses", rules.prefer.senses);
  for (const SenseSpec& sense : rules.senses) checkSense(sense, given, complain);
  const auto in_order = [&](const std::string& path, const std::vector<SenseBounds>& all) {
    for (const SenseBounds& bounds : all) {
      if (bounds.min > bounds.max)
        complain(path + "." + bounds.name,
                 fmt::format("min is {} and max is {}; expected the first to be at most the second",
                             bounds.min, bounds.max));
    }
  };
  in_order("require.senses", rules.require.senses);
  in_order("require.along", rules.require.along);
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
