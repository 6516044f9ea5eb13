#include <fmt/format.h>

#include <array>
#include <set>

#include "rules/language/registry.h"
#include "tests/fuzz/agreement.h"
#include "tests/fuzz/random_files.h"

/// Rule sets of drawn scenes: in place, in files, by regions.
namespace espalier::fuzz {

Drawn RandomFiles::ruleMap() {
  ++depth_;
  Drawn map = table(rules::ruleTable(), "rules:");
  agreeOnRules(map);
  --depth_;
  return map;
}

/// A rule set, in place or in a file.
bool RandomFiles::rules(Drawn& drawn) {
  constexpr int kDeepest = 3;
  if (depth_ >= kDeepest) return false;
  if (numbers_.chance(0.3)) {
    drawn.text = ruleFile();
    return !drawn.text.empty();
  }
  drawn = ruleMap();
  // In place the header may be left out, and so it mostly is.
  if (numbers_.chance(0.9)) std::erase_if(drawn.entries, [](const auto& e) { return e.key == "espalier"; });
  return true;
}

bool RandomFiles::regions(Drawn& drawn) {
  constexpr std::array kRegions{"floor", "wall",  "roof",         "block",
                                "stone", "brick", rules::kOthers, "\"no such\""};
  drawn.kind = Drawn::Kind::map;
  std::set<std::string> seen;
  for (int i = numbers_.whole(1, 3); i > 0; --i) {
    const std::string region = numbers_.pick(kRegions);
    if (!seen.insert(region).second) continue;
    Drawn rule;
    if (numbers_.chance(0.25)) {
      rule.text = "forbid";
    } else if (!rules(rule)) {
      continue;
    } else if (numbers_.chance(0.2)) {
      Drawn whole;
      whole.kind = Drawn::Kind::map;
      whole.entries.push_back({"rules", std::move(rule), true});
      rule = std::move(whole);
    }
    drawn.entries.push_back({region, std::move(rule)});
  }
  return true;
}

/// A new rule file, or one that was written before: none that is still being drawn, so that no circle closes.
std::string RandomFiles::ruleFile() {
  constexpr std::size_t kMostFiles = 6;
  if (odd_ && !colonizes_ && odd_numbers_.chance(0.2)) return "flat_walk";  // of the library
  if (!files_.empty() && (files_.size() >= kMostFiles || numbers_.chance(0.4)))
    return numbers_.pick(files_).name;
  if (depth_ >= 2) return "";
  File file;
  file.root = ruleMap();
  file.name = fmt::format("rules_{}.yaml", files_.size() + 1);
  files_.push_back(std::move(file));
  return files_.back().name;
}

}  // namespace espalier::fuzz
