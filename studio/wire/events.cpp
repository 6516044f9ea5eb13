#include "studio/wire/events.h"

#include <algorithm>

#include "scenes/clean_text.h"
#include "scenes/job/seed_failure_words.h"
#include "scenes/lights.h"
#include "studio/wire/json.h"

namespace espalier::studio {
namespace {

/// The word that is meant, where a problem's text asks "did you mean 'x'?" at its end.
std::string meantIn(const std::string& text) {
  constexpr std::string_view kAsks = "did you mean '";
  const std::size_t at = text.rfind(kAsks);
  if (at == std::string::npos || !text.ends_with("'?")) return {};
  const std::size_t begin = at + kAsks.size();
  return text.substr(begin, text.size() - 2 - begin);
}

Json problemJson(const scenes::Problem& problem, const char* severity, const FileNames& names) {
  Json json{
      {"file", names(problem.path)}, {"severity", severity}, {"message", scenes::cleanText(problem.text)}};
  if (problem.line > 0) {
    json["line"] = problem.line;
    json["column"] = problem.column;
  }
  if (problem.end_column > 0) {
    json["end_line"] = problem.line;
    json["end_column"] = problem.end_column;
  }
  if (!problem.key.empty()) json["key"] = problem.key;
  if (const std::string meant = meantIn(problem.text); !meant.empty()) json["fix"] = meant;
  return json;
}

Json problemList(const Told& told, const FileNames& names) {
  Json list = Json::array();
  for (const scenes::Problem& error : told.errors) list.push_back(problemJson(error, "error", names));
  for (const scenes::Problem& warning : told.warnings) list.push_back(problemJson(warning, "warning", names));
  return list;
}

Json outcomesJson(const sim::OutcomeCounts& counts) {
  Json json = Json::object();
  for (std::size_t o = 0; o < sim::kOutcomes; ++o)
    json[std::string(sim::nameOf(static_cast<sim::Outcome>(o)))] = counts[o];
  return json;
}

Json seedsJson(const scenes::Scene& scene, const sim::Frame& frame,
               const std::vector<sim::Planting>& plantings) {
  Json seeds = Json::array();
  for (std::size_t p = 0; p < plantings.size(); ++p) {
    const std::size_t written = scene.plants[p].seeds.size();
    for (std::size_t s = 0; s < plantings[p].seeds.size(); ++s) {
      const bool movable = s < written;
      const sim::Vec3 at_m =
          movable ? scene.plants[p].seeds[s].at_m : sim::worldFromVoxel(frame, plantings[p].seeds[s].at_vx);
      seeds.push_back({{"planting", plantings[p].name},
                       {"seed", s},
                       {"key", movable ? scene.plants[p].seeds[s].key : ""},
                       {"at_m", jsonOf(at_m)},
                       {"movable", movable}});
    }
  }
  return seeds;
}

}  // namespace

std::string problemsJson(const Told& told, const FileNames& names) {
  return textOf(problemList(told, names));
}

std::string helloEvent(Version version) {
  return textOf({{"event", "hello"}, {"version", version}});
}

std::string problemsEvent(Version version, Depth depth, const Told& told, const FileNames& names) {
  return textOf({{"event", "problems"},
                 {"version", version},
                 {"depth", depth == Depth::text ? "text" : "site"},
                 {"problems", problemList(told, names)}});
}

std::string busyEvent(Version version, const std::string& stage, double share) {
  return textOf({{"event", "busy"}, {"version", version}, {"stage", stage}, {"share", share}});
}

std::string sceneEvent(Version version, const scenes::Scene& scene, const scenes::Site& site,
                       const std::vector<sim::Planting>& plantings, const std::string& mesh) {
  const sim::Frame& frame = site.world.frame();
  Json cameras = Json::array();
  for (const scenes::NamedCamera& named : scene.cameras)
    cameras.push_back({{"name", named.name},
                       {"eye_m", jsonOf(named.camera.eye_m)},
                       {"target_m", jsonOf(named.camera.target_m)},
                       {"fov_deg", named.camera.fov_deg}});
  Json fields = Json::array();
  for (const scenes::FieldSpec& field : scene.fields) fields.push_back(field.name);
  const sim::Vec3 half(0.5);
  return textOf({{"event", "scene"},
                 {"version", version},
                 {"name", scene.name},
                 {"site", mesh},
                 {"low_m", jsonOf(sim::worldFromVoxel(frame, -half))},
                 {"high_m", jsonOf(sim::worldFromVoxel(frame, sim::Vec3(frame.size) - half))},
                 {"voxel_m", frame.voxel_m},
                 {"size", jsonOf(frame.size)},
                 {"layers", site.world.layers()},
                 {"iterations", scene.iterations},
                 {"cameras", std::move(cameras)},
                 {"seeds", seedsJson(scene, frame, plantings)},
                 {"sun",
                  {{"direction", jsonOf(scenes::shadowDirection(scene.sun))},
                   {"strength", scene.sun.brightness},
                   {"colour", {1.0, 0.94, 0.84}}}},
                 {"sky", {{"colour", jsonOf(scene.sky.tint)}, {"strength", scene.sky.brightness}}},
                 {"fields", std::move(fields)}});
}

std::string growthEvent(Version version, const sim::Growth& growth, int iterations, std::size_t alive,
                        double seconds) {
  std::size_t segments = 0, elements = 0;
  Json plants = Json::array();
  for (const sim::Plant& plant : growth.plants) {
    const std::size_t of_plant = plant.skeleton.parent.empty() ? 0 : plant.skeleton.parent.size() - 1;
    segments += of_plant;
    elements += plant.elements.size();
    plants.push_back({{"segments", of_plant}, {"elements", plant.elements.size()}});
  }
  return textOf({{"event", "growth"},
                 {"version", version},
                 {"iteration", growth.iterations},
                 {"iterations", iterations},
                 {"segments", segments},
                 {"elements", elements},
                 {"sites", alive},
                 {"done", false},
                 {"seconds", seconds},
                 {"plants", std::move(plants)}});
}

std::string grownEvent(Version version, const scenes::Report::Growth& growth, int iterations,
                       const std::string& ending, double seconds) {
  std::size_t segments = 0, elements = 0;
  Json plants = Json::array();
  for (const auto& plant : growth.plants) {
    segments += plant.segments;
    elements += plant.elements;
    Json one{{"name", plant.name}, {"segments", plant.segments}, {"elements", plant.elements}};
    if (plant.failure) one["failure"] = scenes::whyItDidNotGrow(*plant.failure);
    plants.push_back(std::move(one));
  }
  return textOf(
      {{"event", "growth"},
       {"version", version},
       {"iteration", growth.iterations},
       {"iterations", iterations},
       {"segments", segments},
       {"elements", elements},
       {"sites", 0},
       {"done", true},
       {"seconds", seconds},
       {"hash", sim::hexOf(growth.state_hash)},
       {"ending", ending},
       {"plants", std::move(plants)},
       {"poor", scenes::poorPlants(growth.plants)},
       {"outcomes", {{"buds", outcomesJson(growth.buds)}, {"trials", outcomesJson(growth.trials)}}}});
}

std::string stagesEvent(Version version, const StageCounts& counts) {
  Json ran = Json::object(), seconds = Json::object(), all = Json::object();
  for (const auto& [stage, done] : counts.ran) {
    ran[stage] = done.first;
    seconds[stage] = done.second;
  }
  for (const auto& [stage, times] : counts.all) all[stage] = times;
  return textOf({{"event", "stages"},
                 {"version", version},
                 {"ran", std::move(ran)},
                 {"all", std::move(all)},
                 {"seconds", std::move(seconds)}});
}

}  // namespace espalier::studio
