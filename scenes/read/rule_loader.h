#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "rules/language/rule_set.h"
#include "scenes/problem.h"
#include "scenes/read/document.h"
#include "scenes/scene.h"
#include "scenes/yaml/yaml_tree.h"

namespace espalier::scenes {

/// The file that a word in place of a rule set means, from where the word's own file lies; or the path of one
/// of the library (scenes/read/rule_library.h), where the word is a name and no file is called so.
std::filesystem::path ruleFileOf(const YamlNode& node);

/// Reads rule sets, each file once. Problems go to the list that it was given; where there were some, the
/// rule sets that it returns are not to be used, or null.
class RuleLoader {
 public:
  explicit RuleLoader(Problems& problems, OpenTexts open = {})
      : problems_(problems), open_texts_(std::move(open)) {}

  /// Of a file that has been read: the first of a run.
  std::shared_ptr<const rules::RuleSet> file(const std::filesystem::path& path, const Document& document);
  /// A value of Kind::rules: a path beside the file of the node, or a mapping of rule keys. The mapping's
  /// keys change `enclosing`.
  std::shared_ptr<const rules::RuleSet> reference(const YamlNode& node, const std::string& path,
                                                  const rules::RuleSet& enclosing);
  /// Every place so far that names a region, in the order of reading.
  const std::vector<RegionMention>& mentions() const { return mentions_; }
  struct ReadFile {
    std::filesystem::path path;
    bool from_root = false;      ///< its path, or one on the way to it, is written from the machine's root
    std::uint64_t hash = 0;      ///< of its bytes
    std::string kind = "rules";  ///< or picture
  };
  /// Every file that could be read so far, and rule sets of the library, in the order of reading.
  const std::vector<ReadFile>& readFiles() const { return read_files_; }
  /// Every product of a scene that is asked for so far.
  const std::vector<ProductAsk>& asks() const { return asks_; }
  /// What was written so far and has no effect where it stands.
  const Problems& warnings() const { return warnings_; }

 private:
  using Layers = std::vector<const YamlNode*>;
  struct File {
    std::shared_ptr<const YamlNode> root;
    Layers layers;  ///< the files that it builds on, the farthest first, and itself
    std::shared_ptr<const rules::RuleSet> rules;
  };

  /// `from_root`: the path is written from the machine's root.
  const File* load(const std::filesystem::path& path, const Place& asker, bool from_root = false);
  const File* load(const YamlNode& node);
  const File& take(const std::filesystem::path& path, const Document& document, bool from_root);
  std::shared_ptr<const rules::RuleSet> inPlace(const YamlNode& map, const rules::RuleSet& enclosing);
  std::shared_ptr<const rules::RuleSet> build(const Layers& layers, rules::RuleSet rules);
  /// Finds what elements are painted with, and gives those without polygons cards that fit it.
  void addPictures(const Layers& layers, rules::RuleSet& rules);
  void paintFromFile(rules::Element& element, const YamlNode& texture, bool own_colour);
  void paintStem(rules::Stem& stem, const YamlNode& texture);
  /// Of a file beside the one that asks; null, after a problem was reported, where it is none.
  std::shared_ptr<const sim::Picture> picture(const YamlNode& asker, const std::string& written,
                                              const std::vector<std::string>& drawn);
  void addRegions(const Layers& layers, rules::RuleSet& rules);
  /// A reference within a rule set, to one that holds in a region or stands by.
  std::shared_ptr<const rules::RuleSet> within(const YamlNode& node, const std::string& path,
                                               const rules::RuleSet& enclosing);
  /// Warns of keys of a process that have no effect in such a rule set.
  void warnOfMoot(const YamlNode& node, const std::string& path);
  rules::RegionRule region(const YamlNode& node, const std::string& path, const rules::RuleSet& enclosing);
  void mentionSensed(const Layers& layers);
  void mention(const std::string& region, const Place& place, bool sensed);
  bool countOne(const Place& place);

  Problems& problems_;
  OpenTexts open_texts_;
  std::map<std::string, File> files_;                      ///< by canonical path
  std::vector<std::pair<std::string, std::string>> open_;  ///< files being read: canonical and shown paths
  std::vector<RegionMention> mentions_;
  std::vector<ReadFile> read_files_;
  std::vector<ProductAsk> asks_;
  std::map<std::string, std::shared_ptr<const sim::Picture>> pictures_;  ///< by canonical path; null: no good
  Problems warnings_;
  std::set<std::tuple<const std::string*, int, int>>
      mentioned_;  ///< places: a base is read for each that has it
  int sets_ = 0;
};

}  // namespace espalier::scenes
