#include "tests/fuzz/random_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "render/model/drawn_leaf.h"
#include "rules/language/registry.h"
#include "scenes/read/read_scene.h"
#include "scenes/read/registry.h"
#include "tests/fuzz/agreement.h"

namespace espalier::fuzz {
namespace {

using rules::Kind;

/// What keeps scenes small and plants alive, and would be large by default.
const std::set<std::string> kAlways = {
    "scene:iterations",  "scene:plants",           "scene:plants[].seeds", "scene:cameras",
    "scene:image",       "scene:image.width",      "scene:image.height",   "scene:film.width",
    "scene:film.height", "scene:meshes[].file",    "scene:meshes[].scale", "scene:meshes[].translate",
    "scene:world.voxel", "scene:world.resolution", "scene:world.bounds",   "scene:world.margin",
    "scene:sky",         "scene:sky.rays",         "scene:sky.directions"};

/// What there must be where plants colonize.
const std::set<std::string> kOfFronts = {"scene:attractors",
                                         "scene:fields",
                                         "rules:propagate",
                                         "rules:colonization",
                                         "rules:colonization.attractors",
                                         "rules:colonization.crown"};

/// And where they are laid.
const std::set<std::string> kOfLayers = {"rules:propagate", "rules:diffusion", "rules:elements"};

}  // namespace

RandomFiles::RandomFiles(std::uint64_t seed, std::filesystem::path folder, std::set<std::string> favoured)
    : numbers_(seed),
      folder_(std::move(folder)),
      favoured_(std::move(favoured)),
      world_(drawWorld(numbers_)),
      colonizes_(numbers_.chance(0.35)),
      odd_numbers_(~seed),
      odd_(odd_numbers_.chance(0.25)),
      lays_(!colonizes_ && odd_numbers_.chance(0.15)),
      values_(numbers_, world_.voxel_m, world_.longest_m() / world_.voxel_m) {
  std::filesystem::create_directories(folder_);
  knowSpecials();
}

/// A point in the world, or as far outside of it.
sim::Vec3 RandomFiles::within(double beyond) {
  sim::Vec3 at;
  for (int axis = 0; axis < 3; ++axis)
    at[axis] = std::clamp(world_.middle_m[axis] + numbers_.uniform(-beyond, beyond) * world_.extent_m()[axis],
                          -1e6, 1e6);
  return at;
}

std::string RandomFiles::place(double beyond) {
  const sim::Vec3 at = within(beyond);
  return ValueDrawer::point(at.x, at.y, at.z);
}

/// The same, mostly where none of the meshes stands that may be drawn, as long as they are not turned.
std::string RandomFiles::openPlace(double beyond) {
  const double near = 2.0 * world_.voxel_m / world_.longest_m();
  sim::Vec3 at = within(beyond);
  for (int tries = numbers_.chance(0.95) ? 20 : 0;
       world_.meshes && tries > 0 && standsAt((at - world_.middle_m) / world_.longest_m(), near); --tries)
    at = within(beyond);
  return ValueDrawer::point(at.x, at.y, at.z);
}

void RandomFiles::knowSpecials() {
  const auto special = [this](const std::string& path, std::function<std::string()> draw) {
    specials_[path] = [draw = std::move(draw)](Drawn& drawn) {
      drawn.text = draw();
      return !drawn.text.empty();
    };
  };
  const auto text = [&](const std::string& path, std::function<std::string()> draw) {
    special("scene:" + path, std::move(draw));
  };
  const bool by_resolution = numbers_.chance(0.3);
  text("espalier", [this] { return std::string(numbers_.chance(0.5) ? "scene" : "scene/1"); });
  text("world.voxel", [=, this] { return by_resolution ? "" : fmt::format("{}", world_.voxel_m); });
  text("world.resolution", [=, this] {
    return by_resolution ? fmt::format("{}", std::lround(world_.longest_m() / world_.voxel_m)) : "";
  });
  text("world.margin",
       [this] { return world_.bounds ? "" : fmt::format("{}", world_.voxel_m * numbers_.whole(0, 6)); });
  specials_["scene:world.bounds"] = [this](Drawn& drawn) {
    const sim::Vec3 low = world_.middle_m - 0.5 * world_.extent_m(), high = low + world_.extent_m();
    drawn.kind = Drawn::Kind::map;
    drawn.entries = {{"min", {ValueDrawer::point(low.x, low.y, low.z)}, true, "scene:world.bounds.min"},
                     {"max", {ValueDrawer::point(high.x, high.y, high.z)}, true, "scene:world.bounds.max"}};
    return world_.bounds;
  };
  text("meshes[].file", [this] { return writeMesh(); });
  text("meshes[].lines", [this] {
    const auto at = [&] {
      return ValueDrawer::point(numbers_.uniform(-0.5, 0.5), numbers_.uniform(-0.5, 0.5),
                                numbers_.uniform(-0.5, 0.5));
    };
    return fmt::format("[[{}, {}, {}], [{}]]", at(), at(), at(), at());
  });
  text("sky.background.file", [this] { return writeSky(); });
  // Most are not there, or level.
  special("rules:bias.apex.of", [this] { return std::string(numbers_.chance(0.06) ? "roof" : ""); });
  special("rules:senses.<name>.of", [this] {
    std::vector<std::string> of(rules::kWhose.begin(), rules::kWhose.end());
    if (world_.meshes && numbers_.chance(0.1)) of = {"floor"};
    if (numbers_.chance(0.02)) of = {rules::kOfLines};  // most scenes that are drawn have none
    if (world_.meshes && numbers_.chance(0.1)) of = {rules::kOfSurfaces};
    return numbers_.pick(of);
  });
  // Most tips read what lies between, mostly.
  const auto reading = [this](double low, double high) {
    return fmt::format("{}",
                       numbers_.chance(0.8) ? numbers_.uniform(low, high) : numbers_.uniform(-1e6, 1e6));
  };
  for (const std::string of : {"senses", "along"}) {
    special("rules:require." + of + ".<name>.min", [=] { return reading(-1.0, 0.05); });
    special("rules:require." + of + ".<name>.max", [=] { return reading(0.5, 9.0); });
  }
  text("meshes[].scale", [this] { return fmt::format("{}", world_.longest_m()); });
  for (const std::string of : {"meshes[].", "plants[].skeleton."}) {
    text(of + "unit", [this] {
      return std::string(odd_numbers_.pick(std::array{"m", "m", "m", "cm", "mm", "in", "ft"}));
    });
    text(of + "up", [this] { return std::string(odd_numbers_.pick(std::array{"y", "y", "z"})); });
  }
  text("meshes[].translate",
       [this] { return ValueDrawer::point(world_.middle_m.x, world_.middle_m.y, world_.middle_m.z); });
  text("meshes[].tiled",
       [this] { return std::string(world_.bounds && numbers_.chance(0.2) ? "false" : "true"); });
  // A solid that the world holds some of.
  const auto side = [this] {
    const double least = std::min({world_.extent_m().x, world_.extent_m().y, world_.extent_m().z});
    return std::min(numbers_.uniform(0.1, 1.0) * least, 1e5);
  };
  for (const std::string of : {"scene:attractors.<name>.", "rules:colonization.crown."}) {
    for (const char* const length :
         {"cone.height", "cone.radius", "dome.radius", "cylinder.height", "cylinder.radius", "sphere.radius"})
      special(of + length, [=] { return fmt::format("{}", side()); });
    for (const char* const sides : {"ellipsoid.radii", "box.size"})
      special(of + sides, [=] { return ValueDrawer::point(side(), side(), side()); });
    special(of + "revolution.profile", [=] {
      const double a = side(), b = side();
      return fmt::format("[[0, {}], [{}, {}], [{}, {}], [{}, {}]]", a, 0.1 * b, b, 0.2 * b, a, 0.3 * b,
                         0.1 * a);
    });
    special(of + "count", [this] { return fmt::format("{}", numbers_.whole(1, 300)); });
  }
  text("attractors.<name>.points", [this] { return writePoints("points.csv", 40, 0.5); });
  text("attractors.<name>.picture.file", [this] { return writeSky(); });
  const auto corner = [this](double x, double y, double z) {
    const sim::Vec3 at = world_.middle_m + sim::Vec3(x, y, z) * world_.extent_m();
    return ValueDrawer::point(at.x, at.y, at.z);
  };
  text("attractors.<name>.picture.from",
       [this] { return numbers_.chance(0.3) ? writeMaker() : std::string(); });
  text("attractors.<name>.picture.product",
       [this] { return std::string(numbers_.chance(0.9) ? "view" : "seen"); });
  text("attractors.<name>.picture.top_left", [=] { return corner(-0.45, 0.3, -0.4); });
  text("attractors.<name>.picture.top_right", [=] { return corner(0.45, 0.3, -0.4); });
  text("attractors.<name>.picture.bottom_left", [=] { return corner(-0.45, 0.2, 0.4); });
  text("attractors.<name>.type", [this] { return fmt::format("{}", numbers_.whole(0, 2)); });
  // Seldom: such a start often stands in a mesh.
  text("plants[].points",
       [this] { return numbers_.chance(0.3) ? writePoints("starts.csv", 1, 0.45) : std::string(); });
  text("plants[].type", [this] { return fmt::format("{}", numbers_.whole(0, 2)); });
  // Scaled about the world's origin it mostly stays in the world.
  text("plants[].skeleton.file", [this] { return writeSkeleton(); });
  text("plants[].skeleton.scale", [this] { return fmt::format("{}", numbers_.uniform(0.9, 1.05)); });
  text("plants[].skeleton.rotate", [] { return std::string("[0, 5, 0]"); });
  text("plants[].skeleton.translate", [this] {
    const sim::Vec3 by = numbers_.uniform(-0.1, 0.1) * world_.extent_m();
    return ValueDrawer::point(by.x, by.y, by.z);
  });
  const auto made = [this](double chance) { return numbers_.chance(chance) ? writeMaker() : std::string(); };
  text("meshes[].from", [=] { return made(0.2); });
  text("meshes[].product", [this] { return std::string(numbers_.chance(0.9) ? "plant" : "plants"); });
  text("plants[].skeleton.from", [=] { return made(0.5); });
  text("fields.<name>.file", [this] { return writeVolume(); });
  text("heights.<name>.spacing",
       [this] { return fmt::format("{}", world_.longest_m() / numbers_.whole(2, 60)); });
  text("heights.<name>.over", [this] {
    const sim::Vec3 half = numbers_.uniform(0.1, 0.6) * world_.extent_m();
    return fmt::format("[[{}, {}], [{}, {}]]", world_.middle_m.x - half.x, world_.middle_m.z - half.z,
                       world_.middle_m.x + half.x, world_.middle_m.z + half.z);
  });
  text("heights.<name>.noise.scale",
       [this] { return fmt::format("{}", world_.longest_m() * numbers_.uniform(0.05, 1.0)); });
  text("images[].heights", [this] { return std::string(numbers_.chance(0.8) ? "main" : "other"); });
  text("pieces.<name>.by", [] { return std::string("[main]"); });
  text("pieces.<name>.kerf",
       [this] { return fmt::format("{}", numbers_.uniform(0.03, 0.3) * world_.longest_m()); });
  text("pieces.<name>.rough.amplitude",
       [this] { return fmt::format("{}", numbers_.uniform(0.0, 0.05) * world_.longest_m()); });
  text("pieces.<name>.rough.over",
       [this] { return fmt::format("{}", numbers_.uniform(0.1, 1.0) * world_.longest_m()); });
  text("fields.<name>.grid", [this] { return std::string(numbers_.chance(0.9) ? "up" : "down"); });
  text("attractors.<name>.spacing",
       [this] { return fmt::format("{}", world_.voxel_m * numbers_.whole(1, 9)); });
  text("attractors.<name>.at", [this] { return openPlace(numbers_.chance(0.9) ? 0.3 : 0.6); });
  text("plants[].seeds[].at", [this] { return openPlace(numbers_.chance(0.05) ? 0.5 : 0.4); });
  text("plants[].scatter.region", [this] { return std::string(numbers_.chance(0.9) ? "floor" : "wall"); });
  text("plants[].scatter.count", [this] { return fmt::format("{}", numbers_.whole(1, 6)); });
  text("cameras.<name>.eye", [this] { return openPlace(numbers_.chance(0.9) ? 2.0 : 0.5); });
  text("cameras.<name>.target", [this] { return place(0.4); });
  text("film.camera", [] { return std::string("main"); });
  text("film.path[].camera", [this] { return std::string(numbers_.chance(0.7) ? "main" : "other"); });
  text("film.width", [this] { return fmt::format("{}", 2 * numbers_.whole(8, 24)); });
  text("film.height", [this] { return fmt::format("{}", 2 * numbers_.whole(8, 20)); });
  text("images[].show", [this] {
    constexpr std::array kParts{"[scene, stems]", "[elements]", "[guides, scene]", "[heights]", "[pieces]"};
    return std::string(numbers_.pick(kParts));
  });
  text("images[].camera", [] { return std::string("main"); });
  specials_["scene:images[].of"] = [this](Drawn& drawn) {
    constexpr std::array kOf{"[sky_exposure]", "[vines, sky_exposure]", "[section, section, a]"};
    drawn.text = numbers_.pick(kOf);
    return true;
  };
  text("image.width", [this] { return fmt::format("{}", numbers_.whole(16, 64)); });
  text("image.height", [this] { return fmt::format("{}", numbers_.whole(16, 48)); });
  // Of growth that takes long a little is enough.
  text("iterations", [this] {
    return fmt::format("{}", values_.beyondUsual() ? numbers_.whole(0, 3) : numbers_.whole(0, 24));
  });
  // All sets of a plant grow in one way; of a front they name what the scene has.
  const bool colonizes = colonizes_;
  const auto rule = [&](const std::string& path, std::function<std::string()> draw) {
    special("rules:" + path, std::move(draw));
  };
  const bool lays = lays_;
  rule("propagate", [=] {
    return std::string(colonizes ? "colonization" : lays ? "diffusion" : "random_tree");
  });
  rule("diffusion.steps", [this] {
    const auto step = [&] { return 3.0 * world_.voxel_m * numbers_.uniform(-1.0, 1.0); };
    return fmt::format("[[{}, {}], [{}, {}], [{}, {}]]", step(), step(), step(), step(), step(), step());
  });
  // Nobody waits for more.
  rule("diffusion.rounds", [this] { return fmt::format("{}", numbers_.whole(1, 12)); });
  const bool crowned = numbers_.chance(0.3);
  rule("colonization.attractors", [=] { return std::string(crowned ? "" : "main"); });
  rule("colonization.crown.trunk",
       [=, this] { return fmt::format("{}", numbers_.uniform(-0.2, 0.2) * side()); });
  specials_["rules:colonization.crown"] = [=, this](Drawn& drawn) {
    const rules::Table& front = *rules::find(rules::ruleTable(), "colonization")->child;
    if (crowned) drawn = table(*rules::find(front, "crown")->child, "rules:colonization.crown.");
    if (crowned) agreeOnCrown(drawn, fmt::format("{}", 0.5 * side()), numbers_);
    return crowned;
  };
  rule("stem.texture", [this] { return numbers_.chance(0.3) ? writePicture() : std::string("bark"); });
  rule("elements[].texture",
       [=, this] { return numbers_.chance(0.3) ? writePicture() : numbers_.pick(render::drawnKinds()); });
  rule("elements[].from", [=] { return made(0.3); });
  rule("elements[].product", [this] { return std::string(numbers_.chance(0.9) ? "view" : "seen"); });
  rule("colonization.fields", [=] { return std::string(colonizes ? "[main]" : "[main, other]"); });
  specials_["rules:espalier"] = [this](Drawn& drawn) {
    drawn.text = numbers_.chance(0.5) ? "rules" : "rules/1";
    return true;
  };
}

/// It, or what it holds.
bool RandomFiles::isFavoured(const std::string& path) const {
  const auto next = favoured_.lower_bound(path);
  return next != favoured_.end() && next->starts_with(path) &&
         (next->size() == path.size() || (*next)[path.size()] == '.' || (*next)[path.size()] == '[');
}

bool RandomFiles::wanted(const rules::Key& key, const std::string& path) {
  if (key.required || key.kind == Kind::header) return true;
  if (kAlways.contains(path)) return true;
  if (path == "scene:meshes") return world_.meshes;
  if (path.starts_with("scene:") && (path.ends_with(".unit") || path.ends_with(".up"))) return odd_;
  if (isFavoured(path)) return numbers_.chance(0.9);
  // A world of lines and guides alone has no surface to be lit.
  if (path == "scene:meshes[].lines" || path == "scene:meshes[].guide") return numbers_.chance(0.1);
  if (colonizes_ && kOfFronts.contains(path)) return true;
  if (lays_ && kOfLayers.contains(path)) return true;
  if (path == "scene:plants[].skeleton") return numbers_.chance(0.15);
  if (path == "scene:plants[].scatter" || path == "scene:meshes[].rotate")
    return world_.meshes && numbers_.chance(0.2);
  const bool holds_others = key.child || key.kind == Kind::rules || key.kind == Kind::regions;
  return numbers_.chance(holds_others ? 0.5 : 0.35);
}

Drawn RandomFiles::table(const rules::Table& table, const std::string& path) {
  Drawn map;
  map.kind = Drawn::Kind::map;
  for (const rules::Key& key : table.keys) {
    if (!wanted(key, path + key.name)) continue;
    Drawn drawn;
    if (value(key, path + key.name, drawn))
      map.entries.push_back(
          {key.name, std::move(drawn), key.required || key.kind == Kind::header, path + key.name});
  }
  return map;
}

bool RandomFiles::value(const rules::Key& key, const std::string& path, Drawn& drawn) {
  if (const auto special = specials_.find(path); special != specials_.end()) return special->second(drawn);
  const rules::Key* const brief = rules::briefOf(key);
  const auto one = [&](const std::string& at, Drawn& into) {
    const bool brief_is_enough =
        brief && std::none_of(key.child->keys.begin(), key.child->keys.end(),
                              [&](const rules::Key& k) { return kAlways.contains(at + k.name); });
    if (brief_is_enough && numbers_.chance(0.4)) return value(*brief, at + brief->name, into);
    into = table(*key.child, at);
    return true;
  };
  switch (key.kind) {
    case Kind::section:
      return one(path + ".", drawn);
    case Kind::entries:
    case Kind::named: {
      drawn.kind = key.kind == Kind::named ? Drawn::Kind::map : Drawn::Kind::list;
      constexpr std::array kNames{"main", "other", "\"third one\""};
      const int most = key.most > 0 ? static_cast<int>(std::min<std::size_t>(key.most, 3)) : 3;
      for (int i = 0, count = numbers_.whole(1, most); i < count; ++i) {
        const std::string name = key.kind == Kind::named ? kNames[static_cast<std::size_t>(i)] : "";
        Drawn entry;
        if (!one(path + (key.kind == Kind::named ? ".<name>." : "[]."), entry)) continue;
        if (path == "rules:elements") agreeOnElement(entry, numbers_);
        if (path == "rules:bias.towards") agreeOnPull(entry, numbers_);
        drawn.entries.push_back({name, std::move(entry)});
      }
      return true;
    }
    case Kind::base:
      drawn.text = ruleFile();
      return !drawn.text.empty();
    case Kind::rules:
      return rules(drawn);
    case Kind::regions:
      return regions(drawn);
    default: {
      drawn.text = values_.text(key, usualLimits(path.substr(path.find(':') + 1)).value_or(key.limits));
      return !drawn.text.empty();
    }
  }
}

/// Writes all files; takes out whatever is complained of, and writes them again. What is left to complain of.
std::string RandomFiles::repaired() {
  constexpr int kMostRounds = 60;
  std::string left;
  for (int round = 0; round < kMostRounds; ++round) {
    for (File& file : files_) std::ofstream(folder_ / file.name) << write(file.root);
    const auto problems = scenes::readRulesOrScene(folder_ / files_.back().name).problems();
    if (problems.empty()) return "";
    left = scenes::format(problems);
    // From the end of each file, so that the lines before stay where they are.
    std::map<std::string, int> removed_from;
    for (auto problem = problems.rbegin(); problem != problems.rend(); ++problem) {
      for (File& file : files_) {
        if (problem->path != (folder_ / file.name).string()) continue;
        const auto below = removed_from.find(file.name);
        if (below != removed_from.end() && problem->line >= below->second) continue;
        if (const int from = takeOut(file.root, problem->line)) removed_from[file.name] = from;
      }
    }
    if (removed_from.empty()) break;
  }
  return left;
}

namespace {

void gather(const Drawn& drawn, std::set<std::string>& keys) {
  for (const DrawnEntry& entry : drawn.entries) {
    if (!entry.path.empty()) keys.insert(entry.path);
    gather(entry.value, keys);
  }
}

}  // namespace

WrittenScene RandomFiles::scene() {
  File scene{"scene.yaml", table(scenes::sceneTable(), "scene:")};
  makeAgree(scene.root, numbers_);
  files_.push_back(std::move(scene));
  WrittenScene written;
  written.refused = repaired();
  written.file = folder_ / files_.back().name;
  for (const File& file : files_) gather(file.root, written.keys);
  return written;
}

}  // namespace espalier::fuzz
