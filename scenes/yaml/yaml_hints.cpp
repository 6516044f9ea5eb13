#include "scenes/yaml/yaml_hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "scenes/problem.h"

namespace espalier::scenes {
namespace {

std::string_view trimmed(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r";
  line = line.substr(0, line.find(" #"));
  line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
  return line.substr(0, line.find_last_not_of(kBlank) + 1);
}

/// The nearest line above that says something, as far as it looks like a key that lost its colon, or the
/// space after it: YAML then takes the line below for more of the same text.
std::string lineWithoutColon(const std::string& text, int line) {
  std::vector<std::string_view> lines;
  std::string_view rest = text;
  for (int i = 0; i < line; ++i) {
    const auto end = std::min(rest.find('\n'), rest.size());
    lines.push_back(trimmed(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  while (!lines.empty() && (lines.back().empty() || lines.back().front() == '#')) lines.pop_back();
  if (lines.empty()) return "";
  const auto above = lines.back();
  const bool is_key = above.find(": ") != above.npos || above.ends_with(':');
  const bool is_other = above.find_first_of("[]{}-\"'") == 0 || above.ends_with(',') ||
                        above.ends_with(']') || above.ends_with('}');
  if (is_key || is_other) return "";
  return fmt::format(
      "the line above, {}, has no ': '; expected 'key: value' with a space after the "
      "colon",
      inQuotes(above));
}

}  // namespace

std::string explained(const std::string& message, const std::string& text, int line) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kWords{{
      {"end of map not found",
       "this does not fit here; expected 'key: value' in the same column as the keys above, or an end of "
       "line"},
      {"end of sequence not found",
       "this does not fit here; expected '- entry' in the same column as the entries above"},
      {"end of sequence flow not found", "a list in brackets that does not end; expected ',' or ']'"},
      {"end of map flow not found", "a mapping in braces that does not end; expected ',' or '}'"},
      {"illegal map value",
       "a ':' where no key can stand; expected one 'key: value' a line, keys of one mapping in the same "
       "column"},
      {"illegal block entry",
       "a '-' where no entry of a list can stand; expected spaces, not tabs, and entries in the same column"},
      {"illegal flow end",
       "a closing bracket that does not fit what is open here; expected the other kind, or none"},
      {"illegal EOF in scalar", "a quote that is never closed; expected it closed on the same line"},
      {"unknown token", "a character that cannot begin a value; expected quotes around it"},
  }};
  if (message == "illegal map value" || message == "end of map not found") {
    if (auto hint = lineWithoutColon(text, line); !hint.empty()) return hint;
  }
  for (const auto& [theirs, ours] : kWords) {
    if (message == theirs) return std::string(ours);
  }
  return fmt::format("this is no YAML ({}); expected 'key: value' lines", message);
}

std::string spacedColon(std::string_view word, const std::vector<std::string>& names) {
  const auto colon = word.find(':');
  if (colon == word.npos || std::find(names.begin(), names.end(), word.substr(0, colon)) == names.end())
    return "";
  return fmt::format("; did you mean '{}: {}'?", word.substr(0, colon), word.substr(colon + 1));
}

}  // namespace espalier::scenes
