#include "scenes/job/report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include "scenes/show/light_json.h"

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

Json growth(const Report::Growth& growth) {
  Json plants = Json::array();
  for (const auto& [name, counts] : growth.plants) {
    plants.push_back({{"name", name}, {"segments", counts[0]}, {"elements", counts[1]}});
  }
  return {{"iterations", growth.iterations},
          {"state_hash", fmt::format("{:016x}", growth.state_hash)},
          {"buds", outcomes(growth.buds)},
          {"trials", outcomes(growth.trials)},
          {"plants", plants}};
}

}  // namespace

void describeWorld(Report& report, const Job& job) {
  report.scene = job.scene.name;
  report.frame = job.world.frame();
  report.fills = job.fills;
  report.scene_voxels = job.world.occupied().count();
  report.occupied_voxels = report.scene_voxels;
  for (const auto& tiled : job.meshes) report.degenerate_triangles += tiled.mesh.degenerate_dropped;
}

std::uint64_t peakMemoryBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024u;
}

std::string toJson(const Report& report) {
  Json json;
  json["scene"] = report.scene;
  json["warnings"] = report.warnings;
  const sim::Frame& frame = report.frame;
  json["world"] = {{"size", {frame.size.x, frame.size.y, frame.size.z}},
                   {"voxel_m", frame.voxel_m},
                   {"origin_m", {frame.origin_m.x, frame.origin_m.y, frame.origin_m.z}},
                   {"scene_voxels", report.scene_voxels},
                   {"occupied_voxels", report.occupied_voxels},
                   {"degenerate_triangles_dropped", report.degenerate_triangles}};
  Json fills = Json::array();
  for (const auto& fill : report.fills) {
    fills.push_back(
        {{"object", fill.object}, {"filled_voxels", fill.filled}, {"doubtful_voxels", fill.doubtful}});
  }
  json["world"]["fills"] = fills;
  json["light"] = lightJson(report.light);
  if (report.growth) json["growth"] = growth(*report.growth);
  if (report.exposure) {
    json["exposure"] = {{"surface_voxels", report.exposure->surfaces},
                        {"gap_voxels", report.exposure->gaps},
                        {"free_voxels", report.exposure->in_space}};
  }
  if (report.certificate) json["certificate"] = Json::parse(toJson(*report.certificate));
  json["files"] = report.files;
  Json stages = Json::object();
  for (const auto& [stage, seconds] : report.run.stages_s) stages[stage] = seconds;
  json["run"] = {{"stages_s", stages},
                 {"total_s", report.run.total_s},
                 {"peak_memory_bytes", report.run.peak_memory_bytes},
                 {"threads", report.run.threads}};
  return json.dump(2) + "\n";
}

}  // namespace espalier::scenes
