#include "scenes/read/json_schema.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "rules/language/registry.h"
#include "scenes/read/registry.h"

namespace espalier::scenes {
namespace {

using Json = nlohmann::ordered_json;
using rules::Datum;
using rules::Key;
using rules::Kind;
using rules::Table;

const char* const kNumber = "[+-]?([0-9]+(\\.[0-9]*)?|\\.[0-9]+)([eE][+-]?[0-9]+)?";

// A year may be left out; 29 February then does not exist, and with a year it may.
const char* const kDate =
    "^(([0-9]{4}-)?((0[13578]|1[02])-(0[1-9]|[12][0-9]|3[01])|(0[469]|11)-(0[1-9]|[12][0-9]|30)|"
    "02-(0[1-9]|1[0-9]|2[0-8]))|[0-9]{4}-02-29)$";

Json reference(const std::string& name) {
  return {{"$ref", "#/$defs/" + name}};
}

Json bounded(const Key& key, const char* type) {
  Json schema{{"type", type}};
  const bool whole = std::string_view(type) == "integer";
  const auto number = [&](double bound) {
    return whole ? Json(static_cast<std::int64_t>(bound)) : Json(bound);
  };
  if (std::isfinite(key.limits.min))
    schema[key.limits.above ? "exclusiveMinimum" : "minimum"] = number(key.limits.min);
  if (std::isfinite(key.limits.max)) schema["maximum"] = number(key.limits.max);
  return schema;
}

Json list(Json item, std::size_t least, std::size_t most) {
  Json schema{{"type", "array"}, {"items", std::move(item)}};
  if (least > 0) schema["minItems"] = least;
  if (most > 0) schema["maxItems"] = most;
  return schema;
}

Json anyOf(std::initializer_list<Json> schemas) {
  return {{"anyOf", schemas}};
}

Json lengthText(const std::string& units) {
  return {{"type", "string"}, {"pattern", std::string("^") + kNumber + " *(" + units + ")$"}};
}

/// A constant, a range or a curve of what `one` describes.
Json varying(const Json& one) {
  const Json curve{{"type", "object"},
                   {"additionalProperties", false},
                   {"required", {"over", "points"}},
                   {"properties",
                    {{"over", {{"type", "string"}, {"examples", rules::kAxes}}},
                     {"points", list({{"type", "array"},
                                      {"prefixItems", {{{"type", "number"}}, one}},
                                      {"items", false},
                                      {"minItems", 2}},
                                     2, 256)}}}};
  return anyOf({one, list(one, 2, 2), curve});
}

Json pairs(const Key& key, const Json& first, const Json& second) {
  return list({{"type", "array"}, {"prefixItems", {first, second}}, {"items", false}, {"minItems", 2}}, 1,
              key.most);
}

Json polygons(const Key& key, const Json& coordinate) {
  return list(list(list(coordinate, 3, 3), 3, 64), 1, key.most);
}

Json textOf(const Key& key) {
  Json schema{{"type", "string"}, {"minLength", 1}};
  if (key.most > 0) schema["maxLength"] = key.most;
  return schema;
}

Json table(const Table& keys);
Json valueOf(const Key& key);

Json nested(const Key& key) {
  const Json mapping = table(*key.child);
  const Key* brief = rules::briefOf(key);
  return brief ? anyOf({mapping, valueOf(*brief)}) : mapping;
}

Json regions(const Key& key) {
  const Json file{{"type", "string"}, {"minLength", 1}};
  const Json rule = anyOf({file,
                           {{"type", "object"},
                            {"additionalProperties", false},
                            {"required", {"rules"}},
                            {"properties", {{"rules", anyOf({file, reference("rule_set")})}}}},
                           reference("rule_set")});
  Json others{{"description", "Every region that is not named."}};
  others.update(rule);
  return {{"type", "object"},
          {"maxProperties", key.most},
          {"properties", {{rules::kOthers, std::move(others)}}},
          {"additionalProperties", rule}};
}

Json valueOf(const Key& key) {
  switch (key.kind) {
    case Kind::header:
      return {{"type", "string"}};
    case Kind::flag:
      return {{"type", "boolean"}};
    case Kind::whole:
      return bounded(key, "integer");
    case Kind::whole_range:
      return anyOf({bounded(key, "integer"), list(bounded(key, "integer"), 2, 2)});
    case Kind::number:
      return bounded(key, "number");
    case Kind::value:
      return varying(bounded(key, "number"));
    case Kind::length:
      return varying(anyOf({bounded(key, "number"), lengthText("mm|cm|m|vx")}));
    case Kind::distance:
      return anyOf({bounded(key, "number"), lengthText("mm|cm|m|vx")});
    case Kind::size:
      return varying(anyOf({bounded(key, "number"), lengthText("mm|cm|m")}));
    case Kind::metres:
      return anyOf({bounded(key, "number"), lengthText("mm|cm|m")});
    case Kind::colour:
      return reference("colour");
    case Kind::point:
      return list(bounded(key, "number"), 3, 3);
    case Kind::place:
      return list(anyOf({bounded(key, "number"), lengthText("mm|cm|m")}), 3, 3);
    case Kind::pairs:
      return pairs(key, {{"type", "number"}}, bounded(key, "number"));
    case Kind::outline:
      return pairs(key, anyOf({{{"type", "number"}}, lengthText("mm|cm|m")}),
                   anyOf({bounded(key, "number"), lengthText("mm|cm|m")}));
    case Kind::polygons:
      return anyOf({polygons(key, bounded(key, "number")),
                    polygons(key, anyOf({{{"const", 0}}, lengthText("mm|cm|m")}))});
    case Kind::lines:
      return list(list(list(anyOf({bounded(key, "number"), lengthText("mm|cm|m")}), 3, 3), 1, 10'000), 1,
                  key.most);
    case Kind::choice:
      return {{"enum", key.choices}};
    case Kind::date:
      return {{"type", "string"}, {"pattern", kDate}};
    case Kind::name:
      return reference("name");
    case Kind::names:
      return list(reference("name"), 0, 0);
    case Kind::text:
    case Kind::file:
    case Kind::base:
      return textOf(key);
    case Kind::rules:
      return anyOf({{{"type", "string"}, {"minLength", 1}}, reference("rule_set")});
    case Kind::regions:
      return regions(key);
    case Kind::section:
      return nested(key);
    case Kind::entries:
      return list(nested(key), 0, key.most);
    case Kind::named:
      return {{"type", "object"}, {"maxProperties", key.most}, {"additionalProperties", nested(key)}};
  }
  return {};
}

Json defaultOf(const Datum& datum) {
  if (const auto* flag = std::get_if<bool>(&datum)) return *flag;
  if (const auto* whole = std::get_if<std::int64_t>(&datum)) return *whole;
  if (const auto* number = std::get_if<double>(&datum); number && std::isfinite(*number)) return *number;
  if (const auto* distance = std::get_if<rules::Distance>(&datum); distance && !distance->metres)
    return defaultOf(distance->number);
  if (const auto* range = std::get_if<rules::WholeRange>(&datum))
    return Json::array({range->low, range->high});
  if (const auto* text = std::get_if<std::string>(&datum); text && !text->empty()) return *text;
  if (const auto* value = std::get_if<rules::Value>(&datum);
      value && value->kind == rules::Value::Kind::constant)
    return value->low;
  if (const auto* length = std::get_if<rules::Length>(&datum); length && !length->metres)
    return defaultOf(length->value);
  return {};
}

Json table(const Table& keys) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const auto& key : keys.keys) {
    Json schema{{"description", key.meaning + (key.unit.empty() ? "" : " Unit: " + key.unit + ".")}};
    if (auto value = defaultOf(key.default_value); !value.is_null()) schema["default"] = std::move(value);
    schema.update(valueOf(key));
    properties[key.name] = std::move(schema);
    if (key.required) required.push_back(key.name);
  }
  Json schema{{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
  if (!required.empty()) schema["required"] = std::move(required);
  for (const std::string& name : keys.one_of) schema["anyOf"].push_back({{"required", {name}}});
  return schema;
}

}  // namespace

std::string schemaFor(FileKind kind) {
  const bool is_rules = kind == FileKind::rules;
  const std::string word = is_rules ? "rules" : "scene";
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", is_rules ? "Espalier rule file" : "Espalier scene file"}};
  schema.update(table(is_rules ? rules::ruleTable() : sceneTable()));
  schema["properties"]["espalier"]["enum"] = {word, word + "/1"};
  if (!schema.contains("required")) schema["required"] = Json::array();
  schema["required"].push_back("espalier");
  auto rule_set = table(rules::ruleTable());
  rule_set["properties"]["espalier"]["enum"] = {"rules", "rules/1"};
  const Json channel{{"type", "number"}, {"minimum", 0}, {"maximum", 1}};
  schema["$defs"] = {
      {"name", {{"type", "string"}, {"pattern", "^[A-Za-z0-9_-][A-Za-z0-9_.-]*$"}, {"maxLength", 100}}},
      {"colour", anyOf({{{"type", "string"}, {"pattern", "^#[0-9a-fA-F]{6}$"}}, list(channel, 3, 3)})},
      {"rule_set", std::move(rule_set)}};
  return schema.dump(2) + "\n";
}

}  // namespace espalier::scenes
