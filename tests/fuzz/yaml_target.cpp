// The YAML reader, and what turns its scalars into numbers.
#include <algorithm>

#include "scenes/problem.h"
#include "scenes/yaml/yaml_number.h"
#include "scenes/yaml/yaml_tree.h"
#include "tests/fuzz/input_files.h"
#include "tests/fuzz/target.h"

namespace espalier::fuzz {
namespace {

using scenes::YamlNode;

void requirePlace(const scenes::Place& place, int lines) {
  require(place.line >= 1 && place.line <= lines + 1 && place.column >= 1, "a place outside of the text");
}

void walk(const YamlNode& node, int lines) {
  requirePlace(node.place, lines);
  require(!scenes::described(node).empty(), "a node that cannot be told of");
  std::string wrong;
  scenes::parseNumber(node.text, wrong);
  scenes::parseWhole(node.text, wrong);
  scenes::parseLength(node.text, wrong);
  for (const YamlNode& item : node.items) walk(item, lines);
  for (const scenes::YamlEntry& entry : node.entries) {
    requirePlace(entry.place, lines);
    require(node.entry(entry.key) == &entry, "a key that stands twice");
    walk(entry.value, lines);
  }
}

}  // namespace

std::vector<std::string> seeds() {
  auto texts = sourceFiles("rules/library", ".yaml");
  for (const char* folder : {"scenes/library", "docs/first"}) {
    const auto more = sourceFiles(folder, ".yaml");
    texts.insert(texts.end(), more.begin(), more.end());
  }
  texts.insert(texts.end(), {"a: &x [1, 'it''s', \"\\u00e9\\n\"]\nb: *x\n", "? {a: b}\n: |2-\n  text\n",
                             "%YAML 1.2\n---\n!!str a: !<tag:x> 0x1F\n...\n", "- [.inf, ~, 1e-7, 12 cm]\n",
                             "\xef\xbb\xbf{}\n"});
  return texts;
}

}  // namespace espalier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace espalier;
  const std::string text(fuzz::textOf(data, size));
  const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  scenes::Problems problems;
  const auto root = scenes::parseYaml(text, "f", problems);
  if (root) fuzz::walk(*root, lines + 1);
  fuzz::require(root || !problems.empty(), "a refusal without a word");
  scenes::format(problems.sorted());
  return 0;
}
