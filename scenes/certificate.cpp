#include "scenes/certificate.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "scenes/known_shapes.h"
#include "scenes/spot_check.h"
#include "sim/parallel.h"
#include "sim/sense/surface.h"
#include "sim/sweep.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;

/// A scene's walls lie anywhere between the borders of voxels: each shape lies otherwise (the points of
/// Roberts' R3 sequence, 2018).
sim::Frame frameOf(const KnownShape& shape, double voxel_m, int place) {
  sim::Frame frame = sim::frameAround({shape.mesh}, voxel_m, 2.0 * voxel_m);
  frame.origin_m -= voxel_m * glm::fract(static_cast<double>(place) * Vec3(0.8191725, 0.6710436, 0.5497005));
  return frame;
}

constexpr std::size_t kMostVoxels = 400;  // at one place: truths take their time

/// Where on the surface a voxel's value counts: the foot of its centre.
Vec3 spotOf(const sim::Frame& frame, const sim::TiledVoxel& t) {
  return sim::worldFromVoxel(frame, Vec3(t.voxel) + Vec3(t.surface.normal * t.surface.offset_vx));
}

/// Some voxels of each place, evenly.
std::map<std::string, std::vector<sim::TiledVoxel>> byPlace(const KnownShape& shape,
                                                            const sim::World& world) {
  std::map<std::string, std::vector<sim::TiledVoxel>> places;
  for (const sim::TiledVoxel& t : world.surfaces()) {
    if (t.surface.normal == sim::Vec3f(0.0f)) continue;
    const std::string place = shape.place(spotOf(world.frame(), t), Vec3(t.surface.normal));
    if (!place.empty()) places[place].push_back(t);
  }
  for (auto& [place, voxels] : places) {
    const std::size_t step = (voxels.size() + kMostVoxels - 1) / kMostVoxels;
    for (std::size_t i = 0; i * step < voxels.size(); ++i) voxels[i] = voxels[i * step];
    voxels.resize((voxels.size() + step - 1) / step);
  }
  return places;
}

Certificate::Line compared(const KnownShape& shape, const sim::World& world, const sim::Sky& sky,
                           const std::string& place, const std::vector<sim::TiledVoxel>& voxels) {
  const sim::SurfaceSensors sensors = sim::surfaceSensors(world, voxels);
  const auto open = sim::sweepOpen(world.opaque(), sky.directions, sensors.places);
  const std::vector<float> values = sim::surfaceSky(sensors, open, sky);
  std::vector<double> truths(values.size());
  sim::parallelForEach(truths.size(), [&](std::size_t i) {
    const sim::TiledVoxel& t = sensors.surfaces[i];
    truths[i] = shape.truth(sky.weighting, spotOf(world.frame(), t), Vec3(t.surface.normal));
  });
  Certificate::Line line;
  line.shape = shape.name;
  line.place = place;
  line.size_m = shape.size_m;
  line.voxels = static_cast<int>(std::lround(shape.size_m / world.frame().voxel_m));
  double squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double error = static_cast<double>(values[i]) - truths[i];
    line.truth += truths[i];
    line.value += static_cast<double>(values[i]);
    squares += error * error;
    if (std::abs(error) > std::abs(line.worst)) line.worst = error;
  }
  const auto n = static_cast<double>(values.size());
  line.truth /= n;
  line.value /= n;
  line.rms = std::sqrt(squares / n);
  return line;
}

std::vector<Certificate::Line> compare(const KnownShape& shape, const sim::Sky& sky, double voxel_m,
                                       int place) {
  const sim::World world = sim::buildWorld(frameOf(shape, voxel_m, place), {shape.mesh}, 0);
  std::vector<Certificate::Line> lines;
  for (const auto& [name, voxels] : byPlace(shape, world))
    lines.push_back(compared(shape, world, sky, name, voxels));
  return lines;
}

}  // namespace

Certificate certifyShapes(const sim::Sky& sky, double voxel_m, const std::vector<int>& widths) {
  constexpr int kLongestStreet = 32;
  constexpr double kTurn = 30.0;  // degrees: walls aslant to the voxels
  std::vector<KnownShape> shapes;
  for (const double tilt : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0})
    shapes.push_back(slope(tilt, kTurn, 24.0 * voxel_m));
  for (const int width : widths) {
    const double size_m = width * voxel_m;
    if (width <= kLongestStreet) shapes.push_back(street(size_m, size_m, voxel_m));
    shapes.push_back(court(size_m, size_m, kTurn, voxel_m));
    shapes.push_back(pit(size_m, size_m / 2.0, voxel_m));
  }
  Certificate certificate;
  certificate.weighting = sky.weighting;
  certificate.directions = sky.directions.size();
  certificate.voxel_m = voxel_m;
  double squares = 0.0;
  int place = 0;
  for (const KnownShape& shape : shapes) {
    for (Certificate::Line& line : compare(shape, sky, voxel_m, ++place)) {
      certificate.bias += line.error();
      squares += line.rms * line.rms;
      certificate.lines.push_back(std::move(line));
    }
  }
  const auto n = static_cast<double>(certificate.lines.size());
  certificate.bias /= n;
  certificate.rms = std::sqrt(squares / n);
  return certificate;
}

Certificate certify(const Job& job) {
  const sim::Frame& frame = job.world.frame();
  const int longest = std::max({frame.size.x, frame.size.y, frame.size.z});
  std::vector<int> widths{8};
  while (2 * widths.back() <= std::min(longest, 64)) widths.push_back(2 * widths.back());
  Certificate certificate = certifyShapes(job.sky, frame.voxel_m, widths);
  certificate.spots = spotCheck(job);
  return certificate;
}

}  // namespace espalier::scenes
