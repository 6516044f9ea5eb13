#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "sim/base/error.h"
#include "sim/light/sky.h"
#include "sim/light/surface.h"
#include "sim/sweep/sweep.h"
#include "tests/bench/peers.h"
#include "tests/bench/rows.h"

namespace espalier::bench {
namespace {

constexpr const char* kSurfaces = "1 surfaces";
constexpr std::size_t kRun = 1024, kSampleEvery = 16;

/// One run of neighbouring places out of sixteen.
Question sampleOf(const Question& question) {
  Question sample{question.directions, {}};
  for (std::size_t i = 0; i < question.places.size(); ++i) {
    if (i / kRun % kSampleEvery == 0) sample.places.push_back(question.places[i]);
  }
  return sample;
}

sim::BitVolume bitsOf(const Question& question, sim::Voxel size) {
  sim::BitVolume bits(size);
  for (const sim::Voxel v : question.places) bits.set(v);
  return bits;
}

std::vector<sim::Mesh> meshesInVoxels(const scenes::Site& site) {
  std::vector<sim::Mesh> meshes;
  for (const auto& tiled : site.meshes) {
    meshes.push_back(tiled.mesh);
    for (sim::Vec3& v : meshes.back().vertices_m) v = sim::voxelFromWorld(site.world.frame(), v);
  }
  return meshes;
}

/// How an answer differs from ours.
struct Difference {
  double places = 0.0;  ///< share with another sum
  double mean = 0.0;    ///< of the fraction of the sky, over all places
};

Difference difference(const Sums& ours, const Sums& theirs) {
  Difference found;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    found.places += ours[i] != theirs[i] ? 1.0 : 0.0;
    found.mean += std::abs(ours[i] - theirs[i]);
  }
  const auto n = static_cast<double>(ours.size());
  return {found.places / n, found.mean / n / sim::ExposureField::kWhole};
}

/// Those whose mean difference is larger answer another question.
constexpr double kSameQuestion = 0.005;

/// The peers that agree with us, as timed on a sample: the fastest of all, and of those that see each voxel's
/// own faces.
struct Fastest {
  const Peer* of_all = nullptr;
  const Peer* on_faces = nullptr;
};

Fastest fastestOf(const Peers& peers, const Question& sample, const Sums& ours, Report& report) {
  std::vector<Sums> answers(peers.size());
  std::vector<Work> works;
  for (std::size_t i = 0; i < peers.size(); ++i)
    works.push_back([&, i] { answers[i] = peers[i]->answer(sample); });
  const std::vector<double> seconds = medianSeconds(works);
  Fastest fastest;
  double least = 0.0, least_on_faces = 0.0;
  for (std::size_t i = 0; i < peers.size(); ++i) {
    const Difference off = difference(ours, answers[i]);
    report.add({kSurfaces, fmt::format("{}, sample: off by {:.4f}", peers[i]->name(), off.mean),
                sample.rays() / seconds[i] / 1e6, "Mray/s", hashOf(answers[i])});
    if (off.mean >= kSameQuestion) continue;
    if (fastest.of_all == nullptr || seconds[i] < least) {
      fastest.of_all = peers[i].get();
      least = seconds[i];
    }
    const bool on_faces = peers[i]->name().find("joined") == std::string::npos;
    if (on_faces && (fastest.on_faces == nullptr || seconds[i] < least_on_faces)) {
      fastest.on_faces = peers[i].get();
      least_on_faces = seconds[i];
    }
  }
  if (fastest.on_faces == nullptr) throw sim::InputError("no peer agrees with the sweep");
  return fastest;
}

}  // namespace

sim::DirectionSet skyOf(int directions) {
  for (int asked = directions;; ++asked) {
    auto set = sim::makeSky({.directions = asked}).directions;
    if (static_cast<int>(set.size()) >= directions) return set;
  }
}

void benchSurfaces(const scenes::Scene& scene, const scenes::Site& site, Report& report) {
  const sim::BitVolume& occupied = site.world.opaque();
  const sim::Sky sky{sim::Weighting::uniform, skyOf(128), 0.0};
  const sim::SurfaceSensors sensors = sim::surfaceSensors(site.world);
  const Question question{sky.directions, sensors.places->voxels()};
  const sim::Voxel size = occupied.size();
  report.title(fmt::format(
      "1. Sky exposure of every surface voxel: {}, {} x {} x {} voxels, {} surfaces judged from {} free "
      "places, {} directions",
      scene.name, size.x, size.y, size.z, sensors.surfaces.size(), question.places.size(),
      sky.directions.size()));

  const Question sample = sampleOf(question);
  const auto sampled = std::make_shared<const sim::VoxelSet>(bitsOf(sample, size));
  const Sums expected = sim::sweepExposure(occupied, sky.directions, sampled).values;
  const Peers embree = embreePeers(occupied, meshesInVoxels(site)), nanovdb = nanovdbPeers(occupied);
  const Fastest of_embree = fastestOf(embree, sample, expected, report);
  const Fastest of_nanovdb = fastestOf(nanovdb, sample, expected, report);
  const std::array<const Peer*, 3> rivals = {of_embree.on_faces, of_nanovdb.on_faces, of_embree.of_all};
  Sums ours;
  std::array<Sums, 3> theirs;
  const std::vector<double> seconds = medianSeconds(
      {[&] { ours = sim::sweepExposure(occupied, sky.directions, sensors.places).values; },
       [&] { sim::surfaceSky(sensors, sim::sweepOpen(occupied, sky.directions, sensors.places), sky); },
       [&] { theirs[0] = rivals[0]->answer(question); }, [&] { theirs[1] = rivals[1]->answer(question); },
       [&] { theirs[2] = rivals[2]->answer(question); }});
  const std::uint64_t state = hashOf(ours);
  const auto add = [&](const std::string& what, double time, std::uint64_t hash) {
    report.add({kSurfaces, what, time * 1e3, "ms", hash});
    report.add({kSurfaces, "  rays", question.rays() / time / 1e6, "Mray/s", hash});
  };
  add("the sweep, at the places", seconds[0], state);
  add("the sweep, a bit a direction, and what each surface receives", seconds[1], state);
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    add(rivals[i]->name(), seconds[2 + i], hashOf(theirs[i]));
    const Difference off = difference(ours, theirs[i]);
    report.note(
        fmt::format("  {:.1f} % of places differ from the sweep; by {:.5f} of the sky in the mean of all",
                    100.0 * off.places, off.mean));
  }
  const double fastest = std::min(seconds[2], seconds[3]);
  report.add({kSurfaces, "the better peer's time (voxel faces, HDDA) over the sweep's, at the places",
              fastest / seconds[0], "times", state, Target{50.0}});
  report.add(
      {kSurfaces, "the same over that of what each surface receives", fastest / seconds[1], "times", state});
  report.add({kSurfaces, "Embree's best, with faces joined into large ones, over the sweep's",
              seconds[4] / seconds[0], "times", state});
}

}  // namespace espalier::bench
