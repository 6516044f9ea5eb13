#include "scenes/job/report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <fstream>
#include <string>

#include "scenes/clean_text.h"
#include "scenes/film.h"
#include "scenes/job/model_files.h"
#include "scenes/job/seed_failure_words.h"
#include "scenes/show/light_json.h"
#include "sim/base/counted.h"
#include "sim/base/parallel.h"
#include "sim/base/whole_file.h"

namespace espalier::scenes {
namespace {

using Json = nlohmann::ordered_json;

Json outcomes(const sim::OutcomeCounts& counts) {
  Json json = Json::object();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    json[std::string(sim::nameOf(static_cast<sim::Outcome>(i)))] = counts[i];
  }
  return json;
}

/// Those that occurred: of thousands of plants nobody wants the others.
Json occurred(const sim::OutcomeCounts& counts) {
  Json json = Json::object();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) json[std::string(sim::nameOf(static_cast<sim::Outcome>(i)))] = counts[i];
  }
  return json;
}

Json plant(const Report::Growth::Plant& plant) {
  Json json = {{"name", plant.name},
               {"planting", plant.planting},
               {"rules", plant.rules},
               {"seed", {{"at_m", {plant.at_m.x, plant.at_m.y, plant.at_m.z}}, {"key", plant.key}}},
               {"segments", plant.segments},
               {"elements", plant.elements},
               {"buds", occurred(plant.tally.sites)},
               {"trials", occurred(plant.tally.trials)}};
  if (plant.loops) json["loops"] = *plant.loops;
  if (plant.meeting_limbs) json["meeting_limbs"] = *plant.meeting_limbs;
  if (plant.triangles) json["triangles"] = *plant.triangles;
  if (plant.failure) json["failed"] = whyItDidNotGrow(*plant.failure);
  return json;
}

Json laid(const Report::Growth::Laid& laid, double voxel_m) {
  const rules::LaidMeasure& measure = laid.measure;
  const double square_m2 = voxel_m * voxel_m;
  Json json = {{"planting", laid.planting},
               {"elements", laid.elements},
               {"surface_m2", measure.surface_vx2 * square_m2},
               {"covered_m2", measure.covered_vx2 * square_m2},
               {"fill", measure.surface_vx2 > 0.0 ? measure.covered_vx2 / measure.surface_vx2 : 0.0}};
  if (const rules::Joints& joints = measure.joints; joints.length_vx > 0.0) {
    json["joints"] = {{"asked_m", joints.asked_vx * voxel_m},
                      {"mean_m", joints.mean_vx * voxel_m},
                      {"deviation_m", joints.deviation_vx * voxel_m},
                      {"along_rims", joints.length_vx / joints.rims_vx}};
  }
  return json;
}

Json growth(const Report::Growth& growth, double voxel_m) {
  Json plants = Json::array();
  for (const Report::Growth::Plant& one : growth.plants) plants.push_back(plant(one));
  Json json = {{"iterations", growth.iterations},
               {"state_hash", fmt::format("{:016x}", growth.state_hash)},
               {"buds", outcomes(growth.buds)},
               {"trials", outcomes(growth.trials)}};
  for (const Report::Growth::Attractors& one : growth.attractors) {
    json["attractors"].push_back({{"name", one.name},
                                  {"waiting", one.fates.waiting},
                                  {"reached", one.fates.reached},
                                  {"given_up", one.fates.given_up},
                                  {"taken", one.fates.taken},
                                  {"ending", one.ending}});
  }
  for (const Report::Growth::Laid& one : growth.laid) json["laid"].push_back(laid(one, voxel_m));
  for (const Report::Growth::Field& field : growth.fields)
    json["fields"].push_back({{"grid", field.grid}, {"voxels", field.voxels}});
  json["plants"] = plants;
  return json;
}

Json pieces(const Report::Pieces& cut) {
  Json json = {{"name", cut.name},           {"of", cut.of},
               {"kerf_m", cut.kerf_m},       {"voxel_m", cut.voxel_m},
               {"solid_voxels", cut.voxels}, {"solid_m3", cut.solid_m3},
               {"crumbs", cut.crumbs},       {"crumbs_m3", cut.crumbs_m3},
               {"pieces", Json::array()}};
  for (const Report::Pieces::Piece& one : cut.pieces) {
    json["pieces"].push_back({{"name", one.name},
                              {"triangles", one.triangles},
                              {"volume_m3", one.volume_m3},
                              {"middle_m", {one.middle_m.x, one.middle_m.y, one.middle_m.z}}});
  }
  return json;
}

/// The most memory that this process has held so far. Not what getrusage() calls so: that begins with what
/// the process held that started this one.
std::uint64_t peakMemoryBytes() {
  std::ifstream status("/proc/self/status");
  std::uint64_t kib = 0;
  for (std::string word; status >> word;) {
    if (word == "VmHWM:" && status >> kib) return kib * 1024u;
  }
  rusage usage{};  // no Linux
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024u;
}

}  // namespace

void describeWorld(Report& report, const Scene& scene, const Site& site) {
  report.scene = scene.name;
  report.made_by = {"Espalier " ESPALIER_VERSION, scene.seed, scene.read_files};
  report.made_by.inputs.insert(report.made_by.inputs.end(), site.mesh_files.begin(), site.mesh_files.end());
  report.read_paths = scene.read_paths;
  report.read_paths.insert(report.read_paths.end(), site.mesh_paths.begin(), site.mesh_paths.end());
  report.run.scene = scene.file.string();
  report.frame = site.world.frame();
  report.facings = site.facings;
  report.fills = site.fills;
  report.scene_voxels = site.world.occupied().count();
  report.occupied_voxels = report.scene_voxels;
  for (const auto& tiled : site.meshes) report.degenerate_triangles += tiled.mesh.degenerate_dropped;
  for (const sim::Mesh* mesh : meshesOf(site)) report.scene_triangles += mesh->triangles.size();
}

std::string toJson(const Report& report) {
  Json json;
  json["scene"] = report.scene;
  json["software"] = report.made_by.software;
  json["seed"] = report.made_by.seed;
  json["inputs"] = Json::array();
  for (const sim::InputFile& input : report.made_by.inputs) {
    json["inputs"].push_back({{"file", input.name}, {"kind", input.kind}, {"xxh3", sim::hexOf(input.hash)}});
  }
  json["warnings"] = report.warnings;
  const sim::Frame& frame = report.frame;
  json["world"] = {{"size", {frame.size.x, frame.size.y, frame.size.z}},
                   {"voxel_m", frame.voxel_m},
                   {"origin_m", {frame.origin_m.x, frame.origin_m.y, frame.origin_m.z}},
                   {"scene_voxels", report.scene_voxels},
                   {"occupied_voxels", report.occupied_voxels},
                   {"scene_triangles", report.scene_triangles},
                   {"degenerate_triangles_dropped", report.degenerate_triangles}};
  Json fills = Json::array();
  for (const auto& fill : report.fills) {
    fills.push_back(
        {{"object", fill.object}, {"filled_voxels", fill.filled}, {"doubtful_voxels", fill.doubtful}});
    if (fill.found) fills.back()["found"] = true;
  }
  json["world"]["fills"] = fills;
  Json facings = Json::array();
  for (const FacingReport& facing : report.facings) {
    facings.push_back({{"object", facing.object},
                       {"turned_triangles", facing.turned},
                       {"share_of_area", facing.area_share}});
  }
  json["world"]["turned"] = facings;
  json["light"] = lightJson(report.light);
  if (report.growth) json["growth"] = growth(*report.growth, report.frame.voxel_m);
  for (const Report::Pieces& one : report.pieces) json["pieces"].push_back(pieces(one));
  if (report.exposure) {
    json["exposure"] = {{"surface_voxels", report.exposure->surfaces},
                        {"gap_voxels", report.exposure->gaps},
                        {"free_voxels", report.exposure->in_space}};
  }
  if (report.certificate) json["certificate"] = Json::parse(toJson(*report.certificate));
  if (report.film) {
    json["film"] = {
        {"frames", report.film->frames}, {"seconds", report.film->seconds}, {"video", report.film->video}};
  }
  json["files"] = report.files;
  Json stages = Json::object();
  for (const auto& [stage, seconds] : report.run.stages_s) stages[stage] = seconds;
  json["run"] = {{"scene", report.run.scene},
                 {"stages_s", stages},
                 {"total_s", report.run.total_s},
                 {"peak_memory_bytes", report.run.peak_memory_bytes},
                 {"threads", report.run.threads}};
  if (report.growth) {
    json["run"]["proposals"] = report.run.proposals;
    json["run"]["went_on_from"] = report.run.went_on_from ? Json(*report.run.went_on_from) : Json();
  }
  if (report.run.foretold) {
    const Foretold& foretold = *report.run.foretold;
    Json of_stages = Json::object();
    for (const auto& [stage, seconds] : foretold.stages_s) of_stages[stage] = seconds;
    json["run"]["foretold"] = {
        {"total_s", foretold.seconds}, {"peak_memory_bytes", foretold.bytes}, {"stages_s", of_stages}};
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // paths may be no UTF-8
}

void finishReport(const std::vector<OutputFile>& files, Report& report) {
  for (const OutputFile& file : files) report.files.push_back(file.name);
  report.run.peak_memory_bytes = peakMemoryBytes();
  report.run.threads = sim::threadCount();
}

void writeReport(const OutputFolder& output, const std::vector<OutputFile>& files, Report& report) {
  finishReport(files, report);
  report.files.emplace_back(kReportFile);
  output.write({fileOf(kReportFile, [&] { return toJson(report); })});
}

std::string endOfSummary(const Report& report, const std::filesystem::path& folder) {
  std::string text;
  for (const FacingReport& facing : report.facings) {
    text += fmt::format(
        "note: {} of '{}', {:.3g} % of its area, {} the other way than wound: there is light; solid: false "
        "takes what is wound as it is\n",
        sim::counted(facing.turned, "triangle"), facing.object, 100.0 * facing.area_share,
        facing.turned == 1 ? "faces" : "face");
  }
  for (const auto& fill : report.fills) {
    if (fill.found) {
      text += fmt::format("note: '{}' is closed, or nearly, and was filled; solid: false leaves it hollow\n",
                          fill.object);
    } else if (fill.doubtful > 0) {
      text += fmt::format(
          "note: '{}' leaks: {} of its voxels were filled, and of {} a vote decided whether they lie "
          "inside\n",
          fill.object, fill.filled, fill.doubtful);
    }
  }
  std::string stages;
  for (const auto& [name, seconds] : report.run.stages_s) stages += fmt::format(", {} {:.2f}", name, seconds);
  text += fmt::format("{:.2f} s ({}), {:.0f} MB", report.run.total_s, stages.substr(2),
                      static_cast<double>(report.run.peak_memory_bytes) / 1e6);
  if (report.growth) text += fmt::format(", state {:016x}", report.growth->state_hash);
  text += "\nwrote\n";
  for (std::size_t i = 0; i < report.files.size(); ++i) {
    text += "  " + oneLine((folder / report.files[i]).string());
    if (report.film && report.film->frames > 1 && report.files[i] == frameFile(0)) {
      i += report.film->frames - 1;
      text += " .. " + report.files[i];
    }
    text += "\n";
  }
  return text;
}

}  // namespace espalier::scenes
