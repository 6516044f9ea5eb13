#include "tests/fuzz/agreement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace espalier::fuzz {
namespace {

constexpr double kMostly = 0.9;

Drawn* find(Drawn& map, const std::string& key) {
  const auto at = std::find_if(map.entries.begin(), map.entries.end(),
                               [&](const DrawnEntry& entry) { return entry.key == key; });
  return at == map.entries.end() ? nullptr : &at->value;
}

void takeOut(Drawn& map, const std::set<std::string>& keys) {
  std::erase_if(map.entries, [&](const DrawnEntry& entry) { return keys.contains(entry.key); });
}

/// What the entries of a list are called: by their names, or else by another key of theirs.
std::vector<std::string> namesOf(Drawn* list, const std::string& else_by) {
  std::vector<std::string> names;
  if (list == nullptr) return names;
  for (DrawnEntry& entry : list->entries) {
    const Drawn* name = find(entry.value, "name");
    if (name == nullptr) name = find(entry.value, else_by);
    if (name != nullptr) names.push_back(name->text);
  }
  return names;
}

/// The names of a mapping's entries.
std::vector<std::string> keysOf(Drawn* map) {
  std::vector<std::string> keys;
  if (map != nullptr) {
    for (const DrawnEntry& entry : map->entries) keys.push_back(entry.key);
  }
  return keys;
}

/// Or in none: ranges of many years have more days than may be.
void putInOneYear(Drawn& dates) {
  const Drawn* const from = find(dates, "from");
  Drawn* const to = find(dates, "to");
  constexpr std::size_t kMonthAndDay = 5;
  if (from && to)
    to->text.replace(0, to->text.size() - kMonthAndDay, from->text, 0, from->text.size() - kMonthAndDay);
}

template <class Below>
void putInOrder(Drawn* range, Below below) {
  Drawn* const from = range ? find(*range, "from") : nullptr;
  Drawn* const to = range ? find(*range, "to") : nullptr;
  if (from && to && below(to->text, from->text)) std::swap(from->text, to->text);
}

void agreeOnSun(Drawn& sun, tests::Numbers& numbers) {
  const bool real = find(sun, "place") != nullptr;
  takeOut(sun, real ? std::set<std::string>{"tilt", "toward", "samples"}
                    : std::set<std::string>{"date", "dates", "hours", "step", "weighting", "north"});
  if (find(sun, "date") && find(sun, "dates")) takeOut(sun, {numbers.chance(0.5) ? "date" : "dates"});
  if (Drawn* const dates = find(sun, "dates")) putInOneYear(*dates);
  putInOrder(find(sun, "dates"), std::less<std::string>());  // as they are written
  putInOrder(find(sun, "hours"),
             [](const std::string& a, const std::string& b) { return std::stod(a) < std::stod(b); });
}

/// Images of what is made show it.
void agreeOnMade(Drawn& images, bool pieces, bool heights) {
  const auto put = [](Drawn& image, const std::string& key, const std::string& text) {
    takeOut(image, {key});
    Drawn value;
    value.text = text;
    image.entries.push_back({key, std::move(value)});
  };
  for (DrawnEntry& image : images.entries) {
    if (image.value.kind != Drawn::Kind::map) continue;
    const bool apart = pieces && find(image.value, "apart"), land = heights && find(image.value, "heights");
    if (!apart && !land) continue;
    put(image.value, "kind", "vines");
    put(image.value, "show", apart ? "[pieces]" : "[heights]");
  }
}

void agreeOnImages(Drawn& images, const std::vector<std::string>& plants,
                   const std::vector<std::string>& meshes, const std::vector<std::string>& fields,
                   tests::Numbers& numbers) {
  for (DrawnEntry& image : images.entries) {
    for (const auto& [key, only] : {std::pair("plant", "threshold"),
                                    {"axis", "section"},
                                    {"of", "contact_sheet"},
                                    {"mesh", "narrow_band"},
                                    {"field", "field"},
                                    {"show", "vines"},
                                    {"apart", "vines"},
                                    {"iteration", "graph"}}) {
      if (find(image.value, key) && numbers.chance(0.5)) find(image.value, "kind")->text = only;
    }
  }
  for (DrawnEntry& image : images.entries) {  // bodies have no side from which they are cut out
    Drawn* const kind = find(image.value, "kind");
    if (kind && kind->text == "cut_out" && numbers.chance(0.8)) kind->text = "narrow_band";
  }
  Drawn others = images;  // a sheet shows no sheets
  std::erase_if(others.entries, [](DrawnEntry& image) {
    const Drawn* const kind = find(image.value, "kind");
    return kind == nullptr || kind->text == "contact_sheet";
  });
  const std::vector<std::string> names = namesOf(&others, "kind");
  for (DrawnEntry& image : images.entries) {
    Drawn* const plant = find(image.value, "plant");
    if (plant && !plants.empty()) plant->text = numbers.pick(plants);
    Drawn* const mesh = find(image.value, "mesh");
    if (mesh && !meshes.empty()) mesh->text = numbers.pick(meshes);
    Drawn* const field = find(image.value, "field");
    if (field && !fields.empty()) field->text = numbers.pick(fields);
    Drawn* const of = find(image.value, "of");
    if (of && !names.empty())
      of->text = fmt::format("[{}]", fmt::join(std::vector{numbers.pick(names), numbers.pick(names)}, ", "));
  }
}

/// What meshes are called: by their names, or else as their files are.
struct Meshes {
  std::vector<std::string> all, bodies;  ///< those that are closed
  std::string pick(bool body, tests::Numbers& numbers) const {
    const std::vector<std::string>& some = body && !bodies.empty() ? bodies : all;
    return some.empty() ? "none" : numbers.pick(some);
  }
};

Meshes meshesOf(Drawn* list) {
  Meshes meshes;
  if (list == nullptr) return meshes;
  for (DrawnEntry& entry : list->entries) {
    const Drawn* const file = find(entry.value, "file");
    const Drawn* const name = find(entry.value, "name");
    if (!name && !file) continue;
    meshes.all.push_back(name ? name->text : file->text.substr(0, file->text.find(".obj")));
    if (file && file->text.starts_with("body")) meshes.bodies.push_back(meshes.all.back());
  }
  return meshes;
}

/// Each has one source, and the keys that belong to it.
void agreeOnAttractors(Drawn& attractors, const Meshes& meshes, tests::Numbers& numbers) {
  const std::set<std::string> of_solids{"at", "spread", "density"};
  const std::set<std::string> no_sources{"at", "spread", "density", "count", "spacing", "type", "waves"};
  for (DrawnEntry& one : attractors.entries) {
    if (meshes.all.empty()) takeOut(one.value, {"surface"});
    if (meshes.bodies.empty() && numbers.chance(0.9)) takeOut(one.value, {"inside"});
    std::set<std::string> sources;
    for (const DrawnEntry& entry : one.value.entries) {
      if (!no_sources.contains(entry.key)) sources.insert(entry.key);
    }
    if (sources.empty()) continue;
    const std::string kept = numbers.pick(std::vector(sources.begin(), sources.end()));
    sources.erase(kept);
    takeOut(one.value, sources);
    const bool on_mesh = kept == "surface" || kept == "inside";
    if (on_mesh) find(one.value, kept)->text = meshes.pick(kept == "inside", numbers);
    if (on_mesh || kept == "points" || kept == "picture") takeOut(one.value, of_solids);
    takeOut(one.value, {kept == "points" ? "count" : "type"});
    if (kept != "surface" && kept != "picture") takeOut(one.value, {"spacing"});
    if (!find(one.value, "spacing")) takeOut(one.value, {"waves"});
  }
}

/// Volumes belong to an axis by a grid, and meshes are there.
void agreeOnFields(Drawn& fields, const Meshes& meshes, tests::Numbers& numbers) {
  for (DrawnEntry& one : fields.entries) {
    Drawn* const axis = find(one.value, "axis");
    if (axis && find(one.value, "file")) axis->text = "grid";
    if (!axis || axis->text != "grid") takeOut(one.value, {"file", "grid"});
    if (meshes.bodies.empty() && numbers.chance(0.9)) takeOut(one.value, {"within"});
    if (Drawn* within = find(one.value, "within")) within->text = meshes.pick(true, numbers);
  }
}

/// They are cut from bodies, by plants, in voxels that show the kerf.
void agreeOnPieces(Drawn& pieces, const Meshes& meshes, const std::vector<std::string>& plants,
                   tests::Numbers& numbers) {
  for (DrawnEntry& one : pieces.entries) {
    const Drawn* const kerf = find(one.value, "kerf");
    if (Drawn* voxel = find(one.value, "voxel"); voxel && kerf)
      voxel->text = fmt::format("{}", 0.25 * std::stod(kerf->text));
    if (Drawn* of = find(one.value, "of")) of->text = meshes.pick(true, numbers);
    if (Drawn* by = find(one.value, "by"); by && !plants.empty())
      by->text = fmt::format("[{}]", numbers.pick(plants));
  }
}

/// They are made of plants, and mostly over all of the world.
void agreeOnHeights(Drawn& heights, const std::vector<std::string>& plants, tests::Numbers& numbers) {
  for (DrawnEntry& one : heights.entries) {
    if (numbers.chance(0.8)) takeOut(one.value, {"over"});
    if (numbers.chance(0.7)) takeOut(one.value, {"iteration"});
    if (Drawn* of = find(one.value, "plants"); of && !plants.empty()) of->text = numbers.pick(plants);
  }
}

/// Each is a file or lines, and guides fill nothing.
void agreeOnMeshes(Drawn& meshes, tests::Numbers& numbers) {
  for (DrawnEntry& mesh : meshes.entries) {
    if (mesh.value.kind != Drawn::Kind::map) continue;
    if (!find(mesh.value, "file") && !find(mesh.value, "lines")) {
      Drawn line;
      line.text = "[[[-0.4, -0.4, 0], [0.4, 0.4, 0]]]";
      mesh.value.entries.push_back({"lines", std::move(line)});
    }
    if (find(mesh.value, "file") && find(mesh.value, "lines"))
      takeOut(mesh.value, {numbers.chance(0.5) ? "lines" : "file"});
    if (find(mesh.value, "lines"))
      takeOut(mesh.value, {"regions", "solid", "optional", "unit", "tiled", "shade"});
    if (find(mesh.value, "guide")) takeOut(mesh.value, {"solid", "tiled", "shade"});
    if (find(mesh.value, "tiled")) takeOut(mesh.value, {"shade"});
  }
}

/// Steps belong to one way around; edges to what lies flat, which elements here seldom do.
void agreeOnDiffusion(Drawn& diffusion) {
  Drawn* const around = find(diffusion, "around");
  if (around && find(diffusion, "steps"))
    around->text = "steps";
  else if (around)
    around->text = around->text == "gaussian" ? "gaussian" : "ring";
  else
    takeOut(diffusion, {"steps"});
}

/// Keys of a background belong to one kind each.
void agreeOnBackground(Drawn& background) {
  Drawn* kind = find(background, "kind");
  const bool picture = find(background, "file") != nullptr,
             gradient = !picture && find(background, "horizon");
  if ((picture || gradient) && kind == nullptr) {
    background.entries.push_back({"kind", {}});
    kind = &background.entries.back().value;
  }
  if (kind != nullptr && (picture || gradient)) kind->text = picture ? "picture" : "gradient";
  if (kind != nullptr && !picture && kind->text == "picture") kind->text = "uniform";
  if (!picture) takeOut(background, {"turn"});
  if (!gradient) takeOut(background, {"horizon"});
}

}  // namespace

void agreeOnElement(Drawn& element, tests::Numbers& numbers) {
  if (numbers.chance(1.0 - kMostly) && numbers.chance(0.2)) return;
  if (find(element, "phyllotaxis") != nullptr) takeOut(element, {"per_segment"});
  // Cards that fit a picture are never as large as polygons may be.
  if (find(element, "texture") != nullptr && numbers.chance(0.6)) takeOut(element, {"polygons"});
  if (find(element, "polygons") != nullptr || find(element, "texture") != nullptr) return;
  Drawn texture;
  texture.text = "ovate";
  element.entries.push_back({"texture", std::move(texture)});
}

void agreeOnRules(Drawn& rules) {
  Drawn* const tree = find(rules, "random_tree");
  if (Drawn* const wander = tree ? find(*tree, "wander") : nullptr) {
    Drawn* const named = find(*wander, "distribution");
    if (find(*wander, "table"))
      takeOut(*wander, {"distribution"});
    else if (named && named->text == "table")
      named->text = "gaussian";
  }
  if (Drawn* const senses = find(rules, "senses")) {
    for (DrawnEntry& sense : senses->entries) {
      Drawn* const measure = find(sense.value, "measure");
      if (measure && measure->text == "height") takeOut(sense.value, {"within"});
      Drawn* const of = find(sense.value, "of");
      const bool of_nearest = measure && (measure->text == "distance" || measure->text == "nearness");
      if (of != nullptr && (of->text == "lines" || of->text == "surfaces") && !of_nearest) of->text = "scene";
      if (!of_nearest) continue;
      if (of == nullptr)
        measure->text = "density";
      else if (of->text == "everything" || of->text == "plants" || of->text == "own")
        of->text = "others";
    }
  }
  if (Drawn* const front = find(rules, "colonization")) {
    Drawn* const acts = find(*front, "acts");
    if (acts && acts->text == "on_all_neighbours") takeOut(*front, {"onto", "repeated"});
  }
  Drawn* const diffusion = find(rules, "diffusion");
  if (diffusion != nullptr) agreeOnDiffusion(*diffusion);
  Drawn* const require = find(rules, "require");
  for (const char* const key : {"proximity", "age", "gap"}) {
    Drawn* const of = std::string(key) == "gap" ? diffusion : require;
    Drawn* const bounds = of ? find(*of, key) : nullptr;
    Drawn* const least = bounds ? find(*bounds, "min") : nullptr;
    Drawn* const most = bounds ? find(*bounds, "max") : nullptr;
    if (!least || !most) continue;
    std::size_t least_end = 0, most_end = 0;
    const double low = std::stod(least->text, &least_end), high = std::stod(most->text, &most_end);
    if (least->text.substr(least_end) == most->text.substr(most_end) && high < low)
      std::swap(least->text, most->text);
  }
}

void agreeOnPull(Drawn& pull, tests::Numbers& numbers) {
  if (find(pull, "point") && find(pull, "direction"))
    takeOut(pull, {numbers.chance(0.5) ? "point" : "direction"});
  if (find(pull, "point") || find(pull, "direction")) return;
  Drawn way;
  way.text = "[1, 0.5, 0]";
  pull.entries.push_back({"direction", std::move(way)});
}

void agreeOnCrown(Drawn& crown, const std::string& radius, tests::Numbers& numbers) {
  const std::set<std::string> no_solids{"trunk", "count", "spread", "density"};
  std::vector<std::string> solids;
  for (const DrawnEntry& entry : crown.entries) {
    if (!no_solids.contains(entry.key)) solids.push_back(entry.key);
  }
  if (solids.empty()) {
    crown.entries.push_back({"sphere", radius});
    return;
  }
  const std::string kept = numbers.pick(solids);
  for (const std::string& solid : solids) {
    if (solid != kept) takeOut(crown, {solid});
  }
}

void makeAgree(Drawn& scene, tests::Numbers& numbers) {
  if (Drawn* plants = find(scene, "plants")) {
    for (DrawnEntry& plant : plants->entries) {
      if (!find(plant.value, "points")) takeOut(plant.value, {"type"});
    }
  }
  if (Drawn* meshes = find(scene, "meshes"); meshes && numbers.chance(kMostly))
    agreeOnMeshes(*meshes, numbers);
  if (Drawn* sky = find(scene, "sky"); sky && find(*sky, "background") && numbers.chance(kMostly))
    agreeOnBackground(*find(*sky, "background"));
  if (Drawn* sun = find(scene, "sun"); sun && numbers.chance(kMostly)) agreeOnSun(*sun, numbers);
  const Meshes meshes = meshesOf(find(scene, "meshes"));
  if (Drawn* attractors = find(scene, "attractors"); attractors && numbers.chance(kMostly))
    agreeOnAttractors(*attractors, meshes, numbers);
  if (Drawn* fields = find(scene, "fields"); fields && numbers.chance(kMostly))
    agreeOnFields(*fields, meshes, numbers);
  if (Drawn* pieces = find(scene, "pieces"); pieces && numbers.chance(kMostly))
    agreeOnPieces(*pieces, meshes, namesOf(find(scene, "plants"), ""), numbers);
  if (Drawn* heights = find(scene, "heights"); heights && numbers.chance(kMostly))
    agreeOnHeights(*heights, namesOf(find(scene, "plants"), ""), numbers);
  if (Drawn* images = find(scene, "images"); images && numbers.chance(kMostly)) {
    agreeOnMade(*images, find(scene, "pieces") != nullptr, find(scene, "heights") != nullptr);
    agreeOnImages(*images, namesOf(find(scene, "plants"), ""), namesOf(find(scene, "meshes"), ""),
                  keysOf(find(scene, "fields")), numbers);
  }
}

}  // namespace espalier::fuzz
