#include "scenes/yaml/yaml_tree.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "scenes/clean_text.h"
#include "scenes/yaml/yaml_hints.h"
#include "scenes/yaml/yaml_text.h"

namespace espalier::scenes {
namespace {

/// Ends the parse where going on would cost too much.
struct Enough {};

/// Escapes such as "\x1b" can put them into a text that has none itself.
bool hasControls(std::string_view value) {
  while (!value.empty()) {
    const auto [code, bytes] = characterAt(value);
    if (bytes > 0 && code != '\n' && isControl(code)) return true;
    value.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return false;
}

/// yaml-cpp marks count bytes; people count characters.
class Places {
 public:
  Places(const std::string& text, std::shared_ptr<const std::string> path) : path_(std::move(path)) {
    line_starts_.push_back(0);
    characters_.reserve(text.size() + 1);
    int count = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      characters_.push_back(count);
      if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) ++count;
      if (text[i] == '\n') line_starts_.push_back(i + 1);
    }
    characters_.push_back(count);
  }

  Place at(const YAML::Mark& mark) const {
    const auto line = std::min(static_cast<std::size_t>(std::max(mark.line, 0)), line_starts_.size() - 1);
    const auto start = line_starts_[line];
    const auto byte =
        std::min(start + static_cast<std::size_t>(std::max(mark.column, 0)), characters_.size() - 1);
    return {path_, static_cast<int>(line) + 1, characters_[byte] - characters_[start] + 1};
  }
  /// The column behind so many bytes from a place on, in the same line.
  int behind(const Place& place, std::size_t byte, std::size_t bytes) const {
    const std::size_t end = std::min(byte + bytes, characters_.size() - 1);
    return place.column + characters_[end] - characters_[std::min(byte, end)];
  }
  std::size_t byteOf(const YAML::Mark& mark) const {
    const auto line = std::min(static_cast<std::size_t>(std::max(mark.line, 0)), line_starts_.size() - 1);
    return line_starts_[line] + static_cast<std::size_t>(std::max(mark.column, 0));
  }

 private:
  std::shared_ptr<const std::string> path_;
  std::vector<std::size_t> line_starts_;
  std::vector<int> characters_;  ///< before each byte
};

class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& text, const Places& places, Problems& problems)
      : text_(text), places_(places), problems_(problems) {}

  YamlNode takeRoot() { return std::move(root_); }
  int documents() const { return documents_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) {
      problems_.add(places_.at(mark),
                    "something after the end of the mapping; expected one mapping from the first column on, "
                    "and no '---'");
      throw Enough{};
    }
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuseAnchor(mark, anchor);
    take(fresh(YamlNode::Kind::null, mark));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    problems_.add(places_.at(mark),
                  "an alias (*name); expected the value itself: aliases are not part of these files");
    auto node = fresh(YamlNode::Kind::null, mark);
    node.refused = true;
    take(std::move(node));
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuseAnchor(mark, anchor);
    auto node = fresh(YamlNode::Kind::scalar, mark);
    node.text = value;
    node.quoted = tag == "!";
    const std::size_t begin = places_.byteOf(mark);
    const char first = at(begin);
    const bool in_quotes = first == '"' || first == '\'';
    if (const std::size_t bytes = in_quotes ? quotedBytes(begin) : plainBytes(begin, value); bytes > 0)
      node.place.end_column = places_.behind(node.place, begin, bytes);
    if (!(tag == "?" || tag.empty()) && !(tag == "!" && first != '!')) {
      refuseTag(mark, tag);
      node.refused = true;
    }
    if (node.quoted && in_quotes && quotedBytes(begin) == 0) {
      node.refused = true;
      problems_.add(
          node.place,
          fmt::format(
              "a text in quotes that runs over the end of its line; expected a closing {} on the same line",
              first));
    }
    if (hasControls(value)) {
      node.refused = true;
      problems_.add(node.place,
                    fmt::format("the text {} has control characters; expected text of printed characters",
                                inQuotes(value)));
    }
    take(std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::list, mark, tag, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::map, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct Level {
    YamlNode node;
    bool waiting_for_value = false;
    bool keep = true;  ///< false: the key was refused, its value goes nowhere
    std::string key;   ///< whose value is read
    std::unordered_map<std::string, Place> keys;
  };

  char at(std::size_t byte) const { return byte < text_.size() ? text_[byte] : '\0'; }

  /// Of a text in quotes that begins there, with its quotes; 0 where it runs over the end of its line.
  std::size_t quotedBytes(std::size_t start) const {
    const char quote = at(start);
    for (std::size_t i = start + 1; i < text_.size() && text_[i] != '\n'; ++i) {
      if (quote == '"' && text_[i] == '\\') {
        ++i;
        if (at(i) == '\n') return 0;
      } else if (text_[i] == quote) {
        if (quote == '"' || at(i + 1) != quote) return i + 1 - start;
        ++i;
      }
    }
    return 0;
  }
  /// Of a text without quotes; 0 where it is not written as it reads, as over several lines.
  std::size_t plainBytes(std::size_t start, const std::string& value) const {
    return text_.compare(start, value.size(), value) == 0 && value.find('\n') == value.npos ? value.size()
                                                                                            : 0;
  }

  /// The path of what comes next.
  std::string pathHere() const {
    if (levels_.empty()) return "";
    const Level& level = levels_.back();
    const std::string& around = level.node.place.key;
    if (level.node.kind == YamlNode::Kind::list)
      return fmt::format("{}[{}]", around, level.node.items.size());
    return level.waiting_for_value ? joined(around, level.key) : around;
  }
  static std::string joined(const std::string& around, const std::string& key) {
    return around.empty() ? key : around + "." + key;
  }

  void refuseAnchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) {
      problems_.add(
          places_.at(mark),
          "an anchor (&name); expected plain values: anchors and aliases are not part of these files");
    }
  }
  void refuseTag(const YAML::Mark& mark, const std::string& tag) {
    problems_.add(
        places_.at(mark),
        fmt::format("the tag {}; expected plain values: tags are not part of these files", inQuotes(tag)));
  }

  YamlNode fresh(YamlNode::Kind kind, const YAML::Mark& mark) {
    if (++nodes_ > kMaxNodes) {
      problems_.add(places_.at(mark),
                    fmt::format("too many values; expected at most {} in a file", kMaxNodes));
      throw Enough{};
    }
    YamlNode node;
    node.kind = kind;
    node.place = places_.at(mark);
    node.place.key = pathHere();
    return node;
  }

  void open(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    refuseAnchor(mark, anchor);
    if (!(tag == "?" || tag.empty())) refuseTag(mark, tag);
    if (levels_.size() >= kMaxDepth) {
      problems_.add(places_.at(mark),
                    fmt::format("lists and mappings nested too deep; expected at most {} levels", kMaxDepth));
      throw Enough{};
    }
    levels_.push_back({fresh(kind, mark), false, true, {}, {}});
  }

  void close() {
    auto node = std::move(levels_.back().node);
    levels_.pop_back();
    take(std::move(node));
  }

  /// A finished node goes to the list or mapping around it.
  void take(YamlNode node) {
    if (levels_.empty()) {
      root_ = std::move(node);
      return;
    }
    auto& level = levels_.back();
    if (level.node.kind == YamlNode::Kind::list) {
      level.node.items.push_back(std::move(node));
    } else if (!level.waiting_for_value) {
      level.waiting_for_value = true;
      level.keep = takeKey(level, std::move(node));
    } else {
      level.waiting_for_value = false;
      if (!level.keep) return;
      auto& entry = level.node.entries.back();
      // yaml-cpp finds an absent value only on the line below.
      if (node.kind == YamlNode::Kind::null) node.place = entry.place;
      entry.value = std::move(node);
    }
  }

  bool takeKey(Level& level, YamlNode key) {
    if (key.kind != YamlNode::Kind::scalar) {
      problems_.add(key.place, fmt::format("{} as a key; expected a name", described(key)));
      return false;
    }
    level.key = key.text;
    key.place.key = joined(level.node.place.key, key.text);
    const auto [first, is_new] = level.keys.emplace(key.text, key.place);
    if (!is_new) {
      problems_.add(
          key.place,
          fmt::format("the key {} stands here again, after line {} column {}; expected each key once",
                      inQuotes(key.text), first->second.line, first->second.column));
      return false;
    }
    level.node.entries.push_back({std::move(key.text), key.place, {}});
    return true;
  }

  const std::string& text_;
  const Places& places_;
  Problems& problems_;
  std::vector<Level> levels_;
  YamlNode root_;
  std::size_t nodes_ = 0;
  int documents_ = 0;
};

}  // namespace

const YamlEntry* YamlNode::entry(std::string_view key) const {
  const auto at =
      std::find_if(entries.begin(), entries.end(), [&](const YamlEntry& e) { return e.key == key; });
  return at == entries.end() ? nullptr : &*at;
}

std::string described(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::null:
      return "nothing";
    case YamlNode::Kind::scalar:
      return inQuotes(node.text);
    case YamlNode::Kind::list:
      return "a list";
    case YamlNode::Kind::map:
      return "a mapping";
  }
  return "";
}

std::shared_ptr<const YamlNode> parseYaml(const std::string& text, const std::string& shown,
                                          Problems& problems) {
  const auto path = std::make_shared<const std::string>(shown);
  if (!checkText(text, path, problems)) return nullptr;
  const Places places(text, path);
  TreeBuilder builder(text, places, problems);
  try {
    std::istringstream in(text);
    YAML::Parser parser(in);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const Enough&) {
    return nullptr;
  } catch (const YAML::Exception& e) {
    problems.add(places.at(e.mark), explained(e.msg, text, e.mark.line));
    return nullptr;
  }
  auto root = std::make_shared<YamlNode>(builder.takeRoot());
  if (builder.documents() == 0) {
    problems.add({path, 1, 1}, "an empty file; expected 'espalier: rules' or 'espalier: scene' first");
    return nullptr;
  }
  if (root->kind != YamlNode::Kind::map) {
    problems.add(
        root->place,
        fmt::format(
            "{} at the top; expected a mapping that begins with 'espalier: rules' or 'espalier: scene'",
            described(*root)));
    return nullptr;
  }
  return root;
}

}  // namespace espalier::scenes
