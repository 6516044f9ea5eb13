#include "scenes/read/rule_loader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "render/model/drawn_bark.h"
#include "render/model/drawn_leaf.h"
#include "rules/language/registry.h"
#include "scenes/import/picture_reader.h"
#include "scenes/read/document.h"
#include "scenes/read/painted.h"
#include "scenes/read/read_table.h"
#include "scenes/read/rule_library.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

namespace fs = std::filesystem;
using rules::RuleSet;
using RulesPointer = std::shared_ptr<const RuleSet>;

/// Rule sets in one run, files and mappings together; each may hold a megabyte.
constexpr int kMostRuleSets = 256;

const YamlNode* lastGiven(const std::vector<const YamlNode*>& layers, std::string_view key) {
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
    if (const auto* entry = (*layer)->entry(key)) return &entry->value;
  }
  return nullptr;
}

/// A word that names no file beside the one in which it stands. Rule sets of the library know only each
/// other.
bool meansLibrary(const YamlNode& node) {
  if (isLibraryPath(*node.place.path)) return true;
  std::error_code error;
  return node.text.find_first_of("./\\") == std::string::npos && !fs::exists(beside(node, node.text), error);
}

}  // namespace

fs::path ruleFileOf(const YamlNode& node) {
  return meansLibrary(node) ? fs::path(libraryPath(node.text)) : beside(node, node.text);
}

RulesPointer RuleLoader::file(const fs::path& path, const Document& document) {
  return countOne(document.root->place) ? take(path, document, false).rules : nullptr;
}

RulesPointer RuleLoader::reference(const YamlNode& node, const std::string& path, const RuleSet& enclosing) {
  if (node.refused) return nullptr;
  if (node.kind == YamlNode::Kind::scalar && !node.text.empty()) {
    const File* file = load(node);
    return file ? file->rules : nullptr;
  }
  if (node.kind == YamlNode::Kind::map) return inPlace(node, enclosing);
  problems_.add(node.place, fmt::format("{} is {}; expected the path of a rule file, the name of one of the "
                                        "library, or a mapping of rule keys",
                                        path, described(node)));
  return nullptr;
}

const RuleLoader::File* RuleLoader::load(const YamlNode& node) {
  const fs::path path = ruleFileOf(node);
  if (!isLibraryPath(path.string()) || libraryRules(node.text))
    return load(path, node.place, fs::path(node.text).is_absolute());
  problems_.add(
      node.place,
      fmt::format("there is no file {0} here, and no rule set of that name in the library; expected the path "
                  "of a rule file, or one of {1}{2}",
                  inQuotes(node.text), listed(libraryNames(), node.text),
                  didYouMean(node.text, libraryNames())));
  return nullptr;
}

const RuleLoader::File* RuleLoader::load(const fs::path& path, const Place& asker, bool from_root) {
  const auto shown = path.string();
  const auto canonical = canonicalOf(path);
  const auto same = [&](const auto& file) { return file.first == canonical; };
  if (const auto start = std::find_if(open_.begin(), open_.end(), same); start != open_.end()) {
    std::string chain;
    for (auto file = start; file != open_.end(); ++file) chain += file->second + " -> ";
    problems_.add(
        asker,
        fmt::format("rule files that name each other in a circle: {}{}; expected each to end somewhere",
                    chain, shown));
    return nullptr;
  }
  if (const auto known = files_.find(canonical); known != files_.end()) return &known->second;
  if (!countOne(asker)) return nullptr;
  const LibraryRules* const of_library = libraryRules(nameInLibrary(shown));
  const Document document =
      of_library ? documentOf(std::string(of_library->text), shown, asker, FileKind::rules, problems_)
                 : readDocument(shown, asker, FileKind::rules, problems_, open_texts_);
  if (!document.root) return nullptr;
  from_root = from_root || std::any_of(read_files_.begin(), read_files_.end(), [&](const ReadFile& read) {
                return read.from_root && read.path == *asker.path;
              });
  return &take(path, document, from_root);
}

const RuleLoader::File& RuleLoader::take(const fs::path& path, const Document& document, bool from_root) {
  read_files_.push_back({path, from_root, document.hash});
  const auto canonical = canonicalOf(path);
  auto& file = files_[canonical];
  file.root = document.root;
  open_.emplace_back(canonical, path.string());
  if (const auto* base = file.root->entry("base"); base && base->value.kind == YamlNode::Kind::scalar) {
    if (const auto* under = load(base->value)) file.layers = under->layers;
  }
  file.layers.push_back(file.root.get());
  file.rules = build(file.layers, RuleSet{});
  open_.pop_back();
  return file;
}

RulesPointer RuleLoader::inPlace(const YamlNode& map, const RuleSet& enclosing) {
  if (!countOne(map.place)) return nullptr;
  if (map.entry("espalier")) headerOf(map, problems_);
  const auto* base = map.entry("base");
  if (!base || base->value.kind != YamlNode::Kind::scalar) return build({&map}, enclosing);
  Layers layers;
  if (const auto* under = load(base->value)) layers = under->layers;
  layers.push_back(&map);
  return build(layers, RuleSet{});
}

RulesPointer RuleLoader::build(const Layers& layers, RuleSet rules) {
  static const auto paths = pathsOf(rules::ruleTable());
  Reading reading{problems_, paths};
  reading.special = [&](const YamlNode& node, const rules::Key& key, void*, const std::string& path) {
    const bool path_wanted = key.kind == rules::Kind::base;
    if (path_wanted && !node.refused && (node.kind != YamlNode::Kind::scalar || node.text.empty())) {
      problems_.add(node.place,
                    fmt::format("{} is {}; expected {}", path, described(node), rules::expectation(key)));
    }
  };
  for (const auto* layer : layers) readTable(*layer, rules::ruleTable(), &rules, "", reading);
  addPictures(layers, rules);
  runChecks(rules::ruleChecks(), &rules, layers, reading);
  if (const auto* otherwise = lastGiven(layers, "otherwise")) {
    // A rule set in place changes this one as far as it has been read: without regions and without an
    // otherwise.
    rules.otherwise = within(*otherwise, "otherwise", rules);
  }
  addRegions(layers, rules);
  mentionSensed(layers);
  // Branches and twigs keep to the same regions, and fail over as the trunk does.
  const RuleSet trunk = rules;
  if (const auto* branches = lastGiven(layers, "branches"))
    rules.branches = within(*branches, "branches", trunk);
  if (const auto* twigs = lastGiven(layers, "twigs"))
    rules.twigs = within(*twigs, "twigs", rules.branches ? *rules.branches : trunk);
  rules::finish(rules);
  return std::make_shared<const RuleSet>(std::move(rules));
}

void RuleLoader::addPictures(const Layers& layers, RuleSet& rules) {
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
    const auto* stem = (*layer)->entry("stem");
    const auto* bark = stem != nullptr ? stem->value.entry("texture") : nullptr;
    if (!bark) continue;
    if (!rules.stem.texture.empty()) paintStem(rules.stem, bark->value);
    break;
  }
  const auto* elements = lastGiven(layers, "elements");
  if (!elements || elements->items.size() != rules.elements.size()) return;
  for (std::size_t i = 0; i < rules.elements.size(); ++i) {
    rules::Element& element = rules.elements[i];
    const YamlNode& node = elements->items[i];
    const bool own_colour = node.entry("colour") != nullptr;
    if (const auto* texture = node.entry("texture"); texture && !element.texture.empty())
      paintFromFile(element, texture->value, own_colour);
    if (const auto* from = node.entry("from"); from && !element.from.empty()) {
      element.from_here = beside(from->value, element.from).string();
      element.own_colour = own_colour;
      asks_.push_back({element.from_here, element.product, ProductKind::picture, from->value.place});
    }
  }
}

void RuleLoader::paintFromFile(rules::Element& element, const YamlNode& texture, bool own_colour) {
  const std::vector<std::string>& drawn = render::drawnKinds();
  if (std::find(drawn.begin(), drawn.end(), element.texture) != drawn.end()) {
    if (element.polygons.empty()) element.polygons = render::cardsOf(element.texture);
    element.opacity = opacityOf(element, render::bladeShareOf(element.texture));
    return;
  }
  if (auto read = picture(texture, element.texture, drawn)) paint(element, std::move(read), own_colour);
}

void RuleLoader::paintStem(rules::Stem& stem, const YamlNode& texture) {
  if (stem.texture == render::kDrawnBark) return;
  const auto read = picture(texture, stem.texture, {render::kDrawnBark});
  if (!read) return;
  sim::Picture tile = *read;
  tile.tiles = true;
  stem.picture = std::make_shared<const sim::Picture>(std::move(tile));
}

std::shared_ptr<const sim::Picture> RuleLoader::picture(const YamlNode& asker, const std::string& written,
                                                        const std::vector<std::string>& drawn) {
  if (written.find_first_of("./") == std::string::npos) {
    problems_.add(asker.place,
                  fmt::format("texture is {}; expected the path of a PNG file, or one of {}{}",
                              described(asker), fmt::join(drawn, ", "), didYouMean(written, drawn)));
    return nullptr;
  }
  const fs::path path = beside(asker, written);
  const auto [known, added] = pictures_.try_emplace(canonicalOf(path));
  if (!added) return known->second;
  std::error_code error;
  if (!fs::exists(path, error)) {
    problems_.add(asker.place, fmt::format("{}: there is no such file; expected a PNG file", path.string()));
    return nullptr;
  }
  try {
    sim::InputFile read;
    known->second = readPicture(path, read);
    read_files_.push_back({path, fs::path(written).is_absolute(), read.hash, read.kind});
  } catch (const sim::InputError& wrong) {
    problems_.add(asker.place, wrong.what());
  }
  return known->second;
}

void RuleLoader::addRegions(const Layers& layers, RuleSet& rules) {
  const RuleSet plain = rules;
  for (const auto* layer : layers) {
    const auto* regions = layer->entry("regions");
    if (!regions || regions->value.refused) continue;
    const auto& map = regions->value;
    const auto* key = rules::find(rules::ruleTable(), "regions");
    if (map.kind != YamlNode::Kind::map || map.entries.size() > key->most) {
      problems_.add(map.place,
                    fmt::format("regions is {} of {}; expected {}, at most {} of them", described(map),
                                map.items.size() + map.entries.size(), rules::expectation(*key), key->most));
      continue;
    }
    for (const auto& entry : map.entries) {
      auto rule = region(entry.value, "regions." + entry.key, plain);
      if (entry.key == rules::kOthers) {
        rules.others = std::move(rule);
      } else {
        mention(entry.key, entry.place, false);
        rules.regions[entry.key] = std::move(rule);
      }
    }
  }
}

RulesPointer RuleLoader::within(const YamlNode& node, const std::string& path, const RuleSet& enclosing) {
  if (const auto* stem = node.entry("stem")) {
    warnings_.add(stem->place,
                  fmt::format("{}.stem has no effect: a plant has one stem, that of its outermost rule "
                              "set; expected it there",
                              path));
  }
  warnOfMoot(node, path);
  RulesPointer set = reference(node, path, enclosing);
  if (set && set->propagate != enclosing.propagate) {
    const auto* says = node.entry("propagate");
    problems_.add(
        says ? says->value.place : node.place,
        fmt::format("{} propagates otherwise than the rule set that it belongs to; expected the same "
                    "for all of a plant",
                    path));
  }
  return set;
}

void RuleLoader::warnOfMoot(const YamlNode& node, const std::string& path) {
  static const std::set<std::string_view> of_plant = {"attractors", "acts", "onto", "repeated", "fields"};
  static const std::set<std::string_view> of_site = {"avoid", "trials"};
  static const std::set<std::string_view> of_laying = {"fill", "rounds"};
  const bool of_order = path == "branches" || path == "twigs";
  const char* const of_outermost = "a plant has one, that of its outermost rule set";
  const auto warn = [&](const std::string& section, const auto& isMoot, const char* why) {
    const auto* const says = node.entry(section);
    if (!says || says->value.kind != YamlNode::Kind::map) return;
    const auto& known = *rules::find(rules::ruleTable(), section)->child;
    for (const auto& entry : says->value.entries) {
      if (!isMoot(entry.key) || !rules::find(known, entry.key)) continue;
      warnings_.add(entry.place, fmt::format("{}.{}.{} has no effect: {}; expected it there", path, section,
                                             entry.key, why));
    }
  };
  warn(
      "colonization",
      [&](const std::string& key) { return of_order ? of_plant.contains(key) : !of_site.contains(key); },
      of_order ? of_outermost
               : "limbs have it of the trunk's, the branches' or the twigs' rule set, wherever they are");
  warn(
      "diffusion", [&](const std::string& key) { return of_laying.contains(key); }, of_outermost);
}

rules::RegionRule RuleLoader::region(const YamlNode& node, const std::string& path,
                                     const RuleSet& enclosing) {
  if (node.kind == YamlNode::Kind::scalar && node.text == "forbid") return {true, nullptr};
  const bool is_word = node.kind == YamlNode::Kind::scalar && meansLibrary(node);
  if (is_word && !node.refused && !libraryRules(node.text)) {
    std::vector<std::string> words = libraryNames();
    words.emplace_back("forbid");
    problems_.add(node.place,
                  fmt::format("{} is {}; expected 'forbid', the path of a rule file, the name of one of the "
                              "library, or a mapping of rule keys{}",
                              path, described(node), didYouMean(node.text, words)));
    return {};
  }
  const auto* whole = node.entry("rules");
  if (!whole) return {false, within(node, path, enclosing)};
  for (const auto& entry : node.entries) {
    if (entry.key == "rules") continue;
    problems_.add(
        entry.place,
        fmt::format(
            "the key {} beside 'rules', which names a whole rule set; expected it alone; did you mean "
            "'base' instead of 'rules'?",
            inQuotes(entry.key)));
  }
  return {false, within(whole->value, path + ".rules", enclosing)};
}

void RuleLoader::mentionSensed(const Layers& layers) {
  const auto* senses = lastGiven(layers, "senses");
  if (!senses) return;
  for (const auto& sense : senses->entries) {
    const auto* of = sense.value.entry("of");
    if (of && of->value.text != rules::kOfLines && of->value.text != rules::kOfSurfaces &&
        std::find(rules::kWhose.begin(), rules::kWhose.end(), of->value.text) == rules::kWhose.end())
      mention(of->value.text, of->value.place, true);
  }
}

void RuleLoader::mention(const std::string& region, const Place& place, bool sensed) {
  if (mentioned_.emplace(place.path.get(), place.line, place.column).second)
    mentions_.push_back({region, place, sensed});
}

bool RuleLoader::countOne(const Place& place) {
  if (++sets_ <= kMostRuleSets) return true;
  problems_.add(place,
                fmt::format("too many rule sets; expected at most {} in all the files", kMostRuleSets));
  return false;
}

}  // namespace espalier::scenes
