#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "sim/grow.h"
#include "sim/sense/surface.h"
#include "sim/sky.h"
#include "sim/sweep.h"
#include "tests/bench/peers.h"
#include "tests/bench/rows.h"

namespace espalier::bench {
namespace {

constexpr const char* kRow = "1 surfaces";
constexpr std::size_t kRun = 1024, kSampleEvery = 16;

/// One run of neighbouring places out of sixteen.
Question sampleOf(const Question& question) {
  Question sample{question.directions, {}};
  for (std::size_t i = 0; i < question.places.size(); ++i) {
    if (i / kRun % kSampleEvery == 0) sample.places.push_back(question.places[i]);
  }
  return sample;
}

std::vector<sim::Mesh> meshesInVoxels(const scenes::Job& job) {
  std::vector<sim::Mesh> meshes;
  for (const auto& tiled : job.meshes) {
    meshes.push_back(tiled.mesh);
    for (sim::Vec3& v : meshes.back().vertices_m) v = sim::voxelFromWorld(job.world.frame(), v);
  }
  return meshes;
}

/// How an answer differs from ours: places with another sum, and the mean difference of the fraction.
std::string agreement(const Sums& ours, const Sums& theirs) {
  std::size_t other = 0;
  double difference = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    other += ours[i] != theirs[i] ? 1u : 0u;
    difference += std::abs(ours[i] - theirs[i]);
  }
  const auto n = static_cast<double>(ours.size());
  return fmt::format("{:.2f} % of places differ, by {:.5f} of the sky in the mean of all",
                     100.0 * static_cast<double>(other) / n, difference / n / sim::ExposureField::kWhole);
}

struct Timed {
  const Peer* peer = nullptr;
  double seconds = 0.0;
};

/// The fastest on a sample.
const Peer& best(const Peers& peers, const Question& sample, Report& report) {
  Timed fastest;
  for (const auto& peer : peers) {
    Sums sums;
    const double seconds = medianSeconds([&] { sums = peer->answer(sample); });
    report.add({kRow, "trial: " + peer->name(), sample.rays() / seconds / 1e6, "Mray/s", hashOf(sums)});
    if (!fastest.peer || seconds < fastest.seconds) fastest = {peer.get(), seconds};
  }
  return *fastest.peer;
}

}  // namespace

sim::DirectionSet skyOf(int directions) {
  for (int asked = directions;; ++asked) {
    auto set = sim::makeSky({.directions = asked}).directions;
    if (static_cast<int>(set.size()) >= directions) return set;
  }
}

void benchSurfaces(const scenes::Job& job, Report& report) {
  const sim::BitVolume& occupied = job.world.opaque();
  const sim::Sky sky{sim::Weighting::uniform, skyOf(128), 0.0};
  const sim::SurfaceSensors sensors = sim::surfaceSensors(job.world);
  const Question question{sky.directions, sensors.places->voxels()};
  const sim::Voxel size = occupied.size();
  report.title(fmt::format(
      "1. Sky exposure of every surface voxel: {}, {} x {} x {} voxels, {} surfaces judged from {} free "
      "places, {} directions",
      job.scene.name, size.x, size.y, size.z, sensors.surfaces.size(), question.places.size(),
      sky.directions.size()));

  Sums ours;
  const double sweep =
      medianSeconds([&] { ours = sim::sweepExposure(occupied, sky.directions, sensors.places).sums; });
  const std::uint64_t state = hashOf(ours);
  const double whole = medianSeconds(
      [&] { sim::surfaceSky(sensors, sim::sweepOpen(occupied, sky.directions, sensors.places), sky); });
  report.add({kRow, "sweep: the places", sweep * 1e3, "ms", state});
  report.add({kRow, "sweep: the places", question.rays() / sweep / 1e6, "Mray/s", state});
  report.add({kRow, "sweep: a bit a direction, then what each surface receives", whole * 1e3, "ms", state});

  const Question sample = sampleOf(question);
  double fastest = 0.0;
  for (const Peers& peers : {embreePeers(occupied, meshesInVoxels(job)), nanovdbPeers(occupied)}) {
    const Peer& peer = best(peers, sample, report);
    Sums theirs;
    const double seconds = medianSeconds([&] { theirs = peer.answer(question); });
    report.add({kRow, peer.name(), seconds * 1e3, "ms", hashOf(theirs)});
    report.add({kRow, peer.name(), question.rays() / seconds / 1e6, "Mray/s", hashOf(theirs)});
    report.note(agreement(ours, theirs));
    fastest = fastest == 0.0 ? seconds : std::min(fastest, seconds);
  }
  report.add(
      {kRow, "the better peer's time over the sweep's", fastest / sweep, "times", state, Target{50.0}});
  report.add(
      {kRow, "the same, over that of what surfaces receive", fastest / whole, "times", state, Target{50.0}});
}

}  // namespace espalier::bench
