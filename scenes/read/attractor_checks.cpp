#include "scenes/read/attractor_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "rules/language/envelope_keys.h"
#include "scenes/problem.h"

namespace espalier::scenes {
namespace {

using rules::Check;

/// The keys of all sources that an entry states.
std::vector<std::string> sourcesOf(const AttractorsSpec& spec) {
  std::vector<std::string> sources = rules::solidsIn(spec.solid);
  if (!spec.surface.empty()) sources.emplace_back("surface");
  if (!spec.inside.empty()) sources.emplace_back("inside");
  if (!spec.table.file.empty()) sources.emplace_back("points");
  if (spec.picture) sources.emplace_back("picture");
  return sources;
}

template <class Named>
std::vector<std::string> namesOf(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

void checkMeshName(const std::string& name, const std::string& path, const Scene& scene,
                   const Check::Complain& complain) {
  const std::string wrong = notCalled("mesh", name, namesOf(scene.meshes));
  if (!name.empty() && !wrong.empty()) complain(path, wrong);
}

void checkSource(const PictureSpec& picture, const std::string& path, const Check::Complain& complain) {
  if (picture.file.empty() && picture.from.empty())
    complain(path, "a picture without a file; expected file: FILE, or from: SCENE.yaml");
  if (!picture.file.empty() && !picture.from.empty())
    complain(path + ".from", "file and from; expected one of them");
  if (picture.from.empty() && !picture.product.empty())
    complain(path + ".product", "product means nothing without from; expected from: SCENE.yaml beside it");
}

void checkCorners(const PictureSpec& picture, const std::string& path, const Check::Complain& complain) {
  const sim::Vec3 across = picture.top_right_m - picture.top_left_m,
                  down = picture.bottom_left_m - picture.top_left_m;
  const double longest = std::max(glm::length(across), glm::length(down));
  if (!(glm::length(glm::cross(across, down)) > 1e-6 * longest * longest))
    complain(path, "a picture without an area; expected three corners that do not lie on one line");
}

/// Complains of keys that the one source does not know.
void checkMeaning(const AttractorsSpec& spec, const std::string& source, const std::string& path,
                  const Check::Given& given, const Check::Complain& complain) {
  const bool surface = source == "surface", points = source == "points", picture = source == "picture";
  const bool solid = !surface && !points && !picture && source != "inside";
  const auto needs = [&](const char* key, bool meant, const char* expected) {
    const std::string at = path + "." + key;
    if (meant || !given(at)) return;
    complain(at,
             fmt::format("{} means nothing to attractors by {}; expected it with {}", key, source, expected));
  };
  needs("at", solid, "a solid");
  needs("spread", solid, "a solid");
  needs("density", solid, "a solid");
  needs("spacing", surface || picture, "a surface or a picture");
  needs("waves", (surface || picture) && spec.spacing_m, "a surface or a picture, and a spacing");
  needs("count", !points, "a solid, a mesh or a picture");
  needs("type", points, "points");
  if (solid && !spec.at_m)
    complain(path,
             fmt::format("a {} that stands nowhere; expected at: [x, y, z], where its foot is", source));
}

}  // namespace

void checkAttractors(const Scene& scene, const Check::Given& given, const Check::Complain& complain) {
  for (const AttractorsSpec& spec : scene.attractors) {
    const std::string path = "attractors." + spec.name;
    const auto sources = sourcesOf(spec);
    if (sources.empty()) {
      complain(
          path,
          "attractors from nowhere; expected a solid such as dome: {radius: 6 m}, surface: MESH, inside: "
          "MESH, points: FILE or picture: {file: FILE, ...}");
      continue;
    }
    if (sources.size() > 1) {
      complain(path + "." + sources[1],
               fmt::format("attractors by {}; expected one of them", fmt::join(sources, " and ")));
      continue;
    }
    checkMeshName(spec.surface, path + ".surface", scene, complain);
    checkMeshName(spec.inside, path + ".inside", scene, complain);
    if (spec.picture) {
      checkSource(*spec.picture, path + ".picture", complain);
      checkCorners(*spec.picture, path + ".picture", complain);
    }
    checkMeaning(spec, sources.front(), path, given, complain);
    rules::checkEnvelope(spec.solid, path, complain);
    rules::checkStrewing(spec.strewing, path, complain);
  }
}

namespace {

/// What is said of a name in rules that the scene has not; empty for one that it has.
std::string missing(const char* what, const std::string& name, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name) != names.end()) return "";
  if (names.empty())
    return fmt::format("its rules name the {} {}, and the scene has none; expected some under '{}'", what,
                       inQuotes(name), what);
  return fmt::format("its rules name the {} {}; expected one of {}{}", what, inQuotes(name),
                     listed(names, name), didYouMean(name, names));
}

}  // namespace

void checkFronts(const Scene& scene, const rules::Check::Given&, const rules::Check::Complain& complain) {
  const std::vector<std::string> attractors = namesOf(scene.attractors), fields = namesOf(scene.fields);
  for (std::size_t i = 0; i < scene.plants.size(); ++i) {
    const auto& rules = scene.plants[i].rules;
    if (!rules || !colonizes(scene.plants[i])) continue;
    const std::string own = crownOf(scene.plants[i].name);
    if (rules->colonization.crown && std::find(attractors.begin(), attractors.end(), own) != attractors.end())
      complain("attractors." + own,
               fmt::format("the crown of the plants {} is called so; expected another name",
                           inQuotes(scene.plants[i].name)));
    const auto say = [&](const std::string& wrong) {
      if (!wrong.empty()) complain(fmt::format("plants[{}].rules", i), wrong);
    };
    if (!rules->colonization.attractors.empty())
      say(missing("attractors", rules->colonization.attractors, attractors));
    for (const std::string& field : rules->colonization.fields) say(missing("fields", field, fields));
  }
}

void checkFields(const Scene& scene, const rules::Check::Given& given,
                 const rules::Check::Complain& complain) {
  for (const FieldSpec& field : scene.fields) {
    const std::string path = fmt::format("fields.{}", field.name);
    if (field.guide.axis == rules::GuideAxis::grid) {
      if (field.file.empty()) complain(path, "an axis by a grid of no file; expected file: VOLUME.vdb");
    } else {
      for (const char* const key : {"file", "grid"}) {
        if (given(path + "." + key))
          complain(path + "." + key,
                   fmt::format("{} means nothing to another axis; expected it with axis: grid", key));
      }
    }
    checkMeshName(field.within, path + ".within", scene, complain);
    if (field.guide.axis == rules::GuideAxis::direction && field.guide.direction == sim::Vec3(0.0))
      complain(path + ".direction", "a direction without length; expected one that is not [0, 0, 0]");
    if (!field.guide.box) continue;
    const auto& [low, high] = *field.guide.box;
    if (!(low.x < high.x && low.y < high.y && low.z < high.z))
      complain(path + ".box",
               "a box without inside; expected each number of min to be less than that of max");
  }
}

}  // namespace espalier::scenes
