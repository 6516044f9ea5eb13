#include "rules/language/rule_values.h"

#include <fmt/format.h>

#include "rules/language/registry.h"

namespace espalier::rules {
namespace {

void forEachValueIn(const Table& table, const void* object, const std::string& prefix,
                    const std::function<void(const std::string&, const Value&)>& visit) {
  if (object == nullptr) return;
  for (const Key& key : table.keys) {
    const std::string path = prefix + key.name;
    if (key.kind == Kind::section) {
      forEachValueIn(*key.child, key.look(object), path + ".", visit);
    } else if (key.kind == Kind::entries || key.kind == Kind::named) {
      const auto items = key.items(object);
      for (std::size_t i = 0; i < items.size(); ++i) {
        const auto at = key.kind == Kind::named ? "." + items[i].name : fmt::format("[{}]", i);
        forEachValueIn(*key.child, items[i].object, path + at + ".", visit);
      }
    } else if (key.kind == Kind::value || key.kind == Kind::length || key.kind == Kind::size) {
      const Datum datum = key.get(object);
      if (const auto* value = std::get_if<Value>(&datum)) visit(path, *value);
      if (const auto* length = std::get_if<Length>(&datum)) visit(path, length->value);
    }
  }
}

}  // namespace

void forEachValue(const RuleSet& rules,
                  const std::function<void(const std::string& path, const Value& value)>& visit) {
  forEachValueIn(ruleTable(), &rules, "", visit);
}

}  // namespace espalier::rules
