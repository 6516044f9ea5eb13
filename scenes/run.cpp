#include "scenes/run.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "render/gltf.h"
#include "render/plant_model.h"
#include "render/vdb.h"
#include "scenes/job.h"
#include "scenes/pictures.h"
#include "sim/error.h"
#include "sim/parallel.h"
#include "sim/sweep.h"
#include "sim/whole_file.h"

namespace espalier::scenes {
namespace {

/// Times the stages of a run, and stops it between them.
class Stages {
 public:
  Stages(const RunOptions& options, Report& report) : options_(options), report_(report) {}

  template <typename Work>
  auto run(const std::string& name, Work work) {
    if (options_.stop.stop_requested()) throw sim::Stopped();
    if (options_.on_stage) options_.on_stage(name);
    const Timer timer{report_, name};
    return work();
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Timer {
    Report& report;
    std::string name;
    Clock::time_point began = Clock::now();
    ~Timer() {
      const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
      report.run.stages_s.emplace_back(name, seconds);
      report.run.total_s += seconds;
    }
  };

  const RunOptions& options_;
  Report& report_;
};

std::vector<render::PlantModel> modelPlants(const Job& job, const std::vector<sim::Plant>& plants) {
  std::vector<render::PlantModel> models(plants.size());
  sim::parallelFor(plants.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      render::ModelOptions options;
      options.pipe.tip_radius_vx = static_cast<float>(plants[i].stem_radius_vx);
      models[i] = render::modelPlant(plants[i], job.world.frame(), options);
    }
  });
  return models;
}

std::string glb(const Job& job, const std::vector<render::PlantModel>& models) {
  render::ModelScene scene;
  for (const auto& tiled : job.meshes) scene.meshes.push_back(&tiled.mesh);
  for (const auto& model : models) scene.plants.push_back(&model);
  return render::glbBytes(scene);
}

void writeAll(const std::filesystem::path& folder, const std::vector<OutputFile>& files) {
  // All bytes first: nothing is written where a picture cannot be made.
  std::vector<std::string> bytes(files.size());
  sim::parallelForEach(files.size(), [&](std::size_t i) { bytes[i] = files[i].bytes(); });
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw sim::InputError(fmt::format("{}: cannot make the folder: {}", folder.string(), error.message()));
  sim::removeLeftovers(folder);
  sim::parallelForEach(files.size(),
                       [&](std::size_t i) { sim::writeWhole(folder / files[i].name, bytes[i]); });
}

void countPlants(Report& report, const sim::Growth& growth) {
  report.iterations = growth.iterations;
  report.buds = growth.buds;
  report.trials = growth.trials;
  for (const sim::Plant& plant : growth.plants) {
    report.plants.push_back(
        {plant.name, {static_cast<std::size_t>(plant.skeleton.size() - 1), plant.elements.size()}});
  }
}

}  // namespace

Report runScene(Scene scene, const RunOptions& options) {
  Report report;
  Stages stages(options, report);
  Job job = stages.run("tiling", [&] { return prepareJob(std::move(scene)); });
  report.scene = job.scene.name;
  report.frame = job.world.frame();
  report.fills = job.fills;
  report.scene_voxels = job.world.occupied().count();
  for (const auto& tiled : job.meshes) report.degenerate_triangles += tiled.mesh.degenerate_dropped;

  sim::GrowthSettings settings = growthSettings(job);
  settings.stop = options.stop;
  settings.progress = options.on_growth;
  const sim::Growth growth = stages.run("growing", [&] {
    try {
      return sim::grow(job.world, job.plantings, settings);
    } catch (const sim::InputError& error) {
      throw sim::InputError(fmt::format("{}: {}", job.scene.file.string(), error.what()));
    }
  });
  countPlants(report, growth);
  report.occupied_voxels = job.world.occupied().count();
  report.state_hash = sim::stateHash(job.world, growth.plants);

  sim::ExposureField sun, sky;
  stages.run("lighting", [&] {
    sun = sim::sweepExposure(job.world.opaque(), job.sun.directions);
    sky = sim::sweepExposure(job.world.opaque(), sim::receivedBy(job.sky));
  });
  const auto models = stages.run("modelling", [&] { return modelPlants(job, growth.plants); });
  std::vector<OutputFile> files;
  files.push_back({"plant.glb", [&] { return glb(job, models); }});
  files.push_back({"world.vdb", [&] { return render::vdbBytes(job.world, {&sun, &sky}); }});
  if (options.pictures) {
    stages.run("drawing", [&] {
      for (OutputFile& file : drawPictures({job, growth, sun, sky, models}, options.stop)) {
        files.push_back(std::move(file));
      }
    });
  }
  stages.run("writing", [&] { writeAll(options.folder, files); });
  for (const OutputFile& file : files) report.files.push_back(file.name);
  report.files.emplace_back("report.json");
  report.run.peak_memory_bytes = peakMemoryBytes();
  report.run.threads = sim::threadCount();
  sim::writeWhole(options.folder / "report.json", toJson(report));
  return report;
}

namespace {

/// Why buds ended, and which seeds never grew: what somebody who wonders about a thin plant wants to know.
std::string fates(const Report& report) {
  const auto of = [&](sim::Outcome outcome) { return report.buds[static_cast<std::size_t>(outcome)]; };
  std::string text =
      fmt::format("buds that ended: {} found no way, {} too dark, {} too bright, {} in forbidden regions\n",
                  of(sim::Outcome::no_trial), of(sim::Outcome::too_dark), of(sim::Outcome::too_bright),
                  of(sim::Outcome::forbidden));
  std::vector<std::string> dead;
  for (const auto& [name, counts] : report.plants) {
    if (counts[0] == 0) dead.push_back(name);
  }
  if (!dead.empty()) {
    text += fmt::format("note: {} of {} seeds did not grow: {}\n", dead.size(), report.plants.size(),
                        fmt::join(dead, ", "));
  }
  return text;
}

}  // namespace

std::string summary(const Report& report, const std::filesystem::path& folder) {
  std::size_t segments = 0, elements = 0;
  for (const auto& [name, counts] : report.plants) {
    segments += counts[0];
    elements += counts[1];
  }
  const auto& size = report.frame.size;
  std::string text =
      fmt::format("{}: {} x {} x {} voxels of {:.4g} m; {} plants, {} segments, {} leaves in {} iterations\n",
                  report.scene, size.x, size.y, size.z, report.frame.voxel_m, report.plants.size(), segments,
                  elements, report.iterations);
  text += fates(report);
  for (const auto& fill : report.fills) {
    if (fill.doubtful > 0) {
      text += fmt::format("note: '{}' leaks; {} of {} voxels inside are doubtful\n", fill.object,
                          fill.doubtful, fill.filled);
    }
  }
  std::string stages;
  for (const auto& [name, seconds] : report.run.stages_s) stages += fmt::format(", {} {:.2f}", name, seconds);
  text += fmt::format("{:.2f} s ({}), {:.0f} MB, state {:016x}\n", report.run.total_s, stages.substr(2),
                      static_cast<double>(report.run.peak_memory_bytes) / 1e6, report.state_hash);
  text += "wrote\n";
  for (const std::string& file : report.files) text += "  " + (folder / file).string() + "\n";
  return text;
}

}  // namespace espalier::scenes
