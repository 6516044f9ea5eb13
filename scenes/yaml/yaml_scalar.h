#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "rules/language/key.h"
#include "scenes/problem.h"
#include "scenes/yaml/yaml_number.h"
#include "scenes/yaml/yaml_tree.h"

namespace espalier::scenes {

/// Reads single values for a key. Each function reports what is wrong and then returns nothing.
struct ScalarReader {
  const rules::Key& key;
  const std::string& path;  ///< names the key in messages
  Problems& problems;

  /// Reports unless the node was refused before.
  std::nullopt_t say(const YamlNode& node, std::string text) const;
  /// "path what; expected ...".
  std::nullopt_t fail(const YamlNode& node, std::string_view what) const;
  /// A list where a number should stand, and the like.
  std::nullopt_t mismatch(const YamlNode& node) const;

  std::optional<double> number(const YamlNode& node) const;
  /// A number of any size, for what has no limits of its own.
  std::optional<double> anyNumber(const YamlNode& node) const;
  std::optional<std::int64_t> whole(const YamlNode& node) const;
  std::optional<WrittenLength> length(const YamlNode& node) const;
  std::optional<double> metres(const YamlNode& node) const;
  std::optional<bool> flag(const YamlNode& node) const;
  std::optional<std::string> text(const YamlNode& node) const;
  std::optional<std::chrono::year_month_day> date(const YamlNode& node) const;
  std::optional<std::string> name(const YamlNode& node) const;
  std::optional<std::string> choice(const YamlNode& node) const;
  std::optional<sim::Colour> hexColour(const YamlNode& node) const;

 private:
  std::nullopt_t wrongScalar(const YamlNode& node, std::string_view wrong) const;
  bool isPlain(const YamlNode& node) const;
};

}  // namespace espalier::scenes
