#include "sim/relief/relief.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/relief/sparse_noise.h"

namespace espalier::sim {
namespace {

constexpr double kNoiseShare =
    0.8;  // of what the land rises from the nearest line: so far noise goes at most

struct Net {
  const PlanLines& lines;
  std::vector<double> flow, height_m;
  double width_m = 0.0;
};

/// One for each node that is no root, in their order.
std::vector<Course> coursesOf(const Net& net) {
  std::vector<Course> courses;
  for (std::size_t n = 0; n < net.flow.size(); ++n) {
    if (net.lines.parent[n] < 0) continue;
    const auto parent = static_cast<std::size_t>(net.lines.parent[n]);
    courses.push_back({net.lines.at_m[n], net.lines.at_m[parent], net.height_m[n], net.height_m[parent],
                       0.5 * widthOf(net.width_m, net.flow[n])});
  }
  return courses;
}

/// Lines that lie higher than others let the land beside them come down to it, and what they flow into too.
void lowerToLand(Net& net, const Flank& flank) {
  constexpr double kFall = 1e-4;  // metres a metre, that is left where it must be
  const Land land(coursesOf(net), flank);
  std::vector<double> lowest(net.height_m.size());
  parallelFor(lowest.size(), [&](std::size_t begin, std::size_t end) {
    std::int32_t near = 0;
    for (std::size_t n = begin; n < end; ++n) {
      const LandAt at = land.at(net.lines.at_m[n], near);
      lowest[n] = std::min(net.height_m[n], at.height_m);
      near = at.course;
    }
  });
  for (std::size_t n = lowest.size(); n-- > 0;) {
    if (net.lines.parent[n] < 0) continue;
    const auto parent = static_cast<std::size_t>(net.lines.parent[n]);
    const double fall = kFall * glm::distance(net.lines.at_m[n], net.lines.at_m[parent]);
    lowest[parent] = std::min(lowest[parent], lowest[n] - fall);
  }
  net.height_m = std::move(lowest);
}

/// The octaves together; what they do near a line is bounded by what the land rises there.
class Roughness {
 public:
  Roughness(const ReliefNoise& noise, const HeightRaster& raster, std::uint64_t stream)
      : amplitude_m_(noise.amplitude_m) {
    if (amplitude_m_ == 0.0) return;
    const glm::dvec2 high = raster.place(raster.wide - 1, raster.deep - 1);
    double scale_m = noise.scale_m;
    // Waves that the raster cannot show would only be grain.
    for (int i = 0; i < noise.octaves && scale_m >= 2.0 * raster.spacing_m; ++i, scale_m *= 0.5)
      octaves_.emplace_back(stream, static_cast<unsigned>(i), scale_m, raster.low_m, high);
  }

  double at(glm::dvec2 at_m, double rise_m) const {
    const double most = kNoiseShare * rise_m;
    if (octaves_.empty() || most <= 0.0) return 0.0;
    double sum = 0.0, amplitude_m = amplitude_m_;
    for (const SparseNoise& octave : octaves_) {
      sum += amplitude_m * octave.at(at_m);
      amplitude_m *= 0.5;
    }
    return sum * most / (most + std::abs(sum));
  }

 private:
  double amplitude_m_;
  std::vector<SparseNoise> octaves_;
};

}  // namespace

double reliefBytes(const HeightRaster& raster, const PlanLines& lines, const ReliefNoise& noise) {
  const double samples = static_cast<double>(raster.wide) * raster.deep;
  const double nodes = static_cast<double>(lines.parent.size());
  double bytes = samples * 40.0 + nodes * 300.0;
  double scale_m = noise.scale_m;
  for (int i = 0; noise.amplitude_m > 0.0 && i < noise.octaves && scale_m >= 2.0 * raster.spacing_m;
       ++i, scale_m *= 0.5)
    bytes += SparseNoise::bytes(scale_m, raster.spacing_m * glm::dvec2(raster.wide, raster.deep));
  return bytes;
}

Relief makeRelief(HeightRaster raster, const PlanLines& lines, const ReliefLaw& law, std::uint64_t stream) {
  Relief relief;
  // What falls from lines is what rises from them, upside down.
  RiseLaw rise = law.line;
  if (law.falls) rise.base_m = -rise.base_m;
  Net net{lines, flowOf(lines), heightsOf(lines, rise), law.falls ? 0.0 : law.width_m};
  if (!law.falls) lowerToLand(net, law.flank);
  const Land land(coursesOf(net), law.flank);
  const Roughness rough(law.noise, raster, stream);
  const auto samples = static_cast<std::size_t>(raster.wide) * static_cast<std::size_t>(raster.deep);
  raster.height_m.resize(samples);
  relief.beside_m.resize(samples);
  relief.nearest.resize(samples);
  parallelFor(static_cast<std::size_t>(raster.deep), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t z = begin; z < end; ++z) {
      std::int32_t by = 0, near = 0;
      for (int x = 0; x < raster.wide; ++x) {
        const glm::dvec2 at_m = raster.place(x, static_cast<int>(z));
        const std::size_t i = raster.index(x, static_cast<int>(z));
        const LandAt height = land.at(at_m, by), beside = land.distance(at_m, near);
        by = height.course;
        near = beside.course;
        const double up = height.height_m + rough.at(at_m, law.flank.rise(beside.height_m));
        raster.height_m[i] = static_cast<float>(law.falls ? -up : up);
        relief.beside_m[i] = static_cast<float>(beside.height_m);
        relief.nearest[i] = near;
      }
    }
  });
  relief.courses.assign(land.courses().begin(), land.courses().end());
  relief.flow = std::move(net.flow);
  if (!law.falls) {
    relief.water = sampledLines(lines, raster);
    carve(raster, relief.water);
  }
  fillPits(raster, relief.water);
  if (law.floor_m) {
    for (float& height_m : raster.height_m) height_m = std::max(height_m, static_cast<float>(*law.floor_m));
  }
  relief.raster = std::move(raster);
  return relief;
}

}  // namespace espalier::sim
