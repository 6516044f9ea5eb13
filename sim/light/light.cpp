#include "sim/light/light.h"

#include <algorithm>

#include "sim/base/parallel.h"
#include "sim/sweep/sweep.h"

namespace espalier::sim {
namespace {

std::size_t voxelsIn(Voxel size) {
  return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
         static_cast<std::size_t>(size.z);
}

/// With fewer places, casting their rays takes less time than finding what the bricks say, or than following
/// it if it is known. In small worlds that hangs on how many bricks there are; in large ones it costs less
/// for each, and the longer the world, the dearer are rays. As measured on worlds of 5 to 390 million voxels,
/// the large ones with clear bricks of several bricks.
std::size_t fewestForOpenRays(Voxel size, bool known) {
  const std::size_t voxels = voxelsIn(size), edges = static_cast<std::size_t>(size.x + size.y + size.z);
  return known ? std::min(voxels / 400'000, 6'000 / edges) : std::min(voxels / 70'000, 36'000 / edges);
}

DirectionSet both(DirectionSet sky, const DirectionSet& sun) {
  sky.insert(sky.end(), sun.begin(), sun.end());
  return sky;
}

}  // namespace

bool sweepIsCheaper(Voxel size, std::size_t places) {
  constexpr std::size_t kVoxelsPerPlace = 200;  // as measured on worlds of 5 to 13 million voxels
  return places >= voxelsIn(size) / kVoxelsPerPlace;
}

LightSensor::LightSensor(const BitVolume& shape, const LightSource& source)
    : rays_(shape, both(source.random_sky ? DirectionSet{} : source.sky, source.sun)),
      sky_count_(rays_.directions().size() - source.sun.size()),
      shares_(sharesOf(rays_.directions())),
      sky_(shape, source.random_sky ? DirectionSet{} : source.sky),
      sun_(shape, source.sun),
      random_sky_(source.random_sky),
      weighting_(source.weighting) {}

std::vector<Light> LightSensor::at(const BitVolume& opaque, std::span<const Voxel> places, ClearAhead& ahead,
                                   const Bricks* filled) const {
  const Voxel size = opaque.size();
  // As long as it is not known, the places of all questions so far count: who asks of a few at a time comes
  // to find it in the end, at the latest when casting rays has cost as much.
  const std::size_t asked = ahead.known() ? places.size() : ahead.cast(places.size());
  std::vector<Light> lights = asked < fewestForOpenRays(size, ahead.known()) ? byRays(opaque, places)
                              : sweepIsCheaper(size, places.size())
                                  ? bySweep(opaque, places)
                                  : byOpenRays(opaque, places, ahead, filled);
  if (!random_sky_) return lights;
  parallelFor(places.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      lights[i].sky = lookOut(opaque, places[i], *random_sky_, weighting_);
  });
  return lights;
}

std::vector<Light> LightSensor::byRays(const BitVolume& opaque, std::span<const Voxel> places) const {
  std::vector<Light> lights(places.size());
  parallelFor(places.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      lights[i] = {sky_.from(opaque, places[i]), sun_.from(opaque, places[i])};
  });
  return lights;
}

std::vector<Light> LightSensor::byOpenRays(const BitVolume& opaque, std::span<const Voxel> places,
                                           ClearAhead& ahead, const Bricks* filled) const {
  const std::vector<std::uint64_t> open = rays_.from(opaque, places, ahead, filled);
  return lightsOf(places.size(),
                  [&](std::size_t i) { return std::span(open).subspan(i * rays_.words(), rays_.words()); });
}

std::vector<Light> LightSensor::bySweep(const BitVolume& opaque, std::span<const Voxel> places) const {
  BitVolume asked(opaque.size());
  for (const Voxel place : places) asked.set(place);
  const auto where = std::make_shared<const VoxelSet>(std::move(asked));
  const OpenTable open = sweepOpen(opaque, rays_.directions(), where);
  return lightsOf(places.size(), [&](std::size_t i) { return open.row(where->number(places[i])); });
}

std::vector<Light> LightSensor::lightsOf(
    std::size_t places, const std::function<std::span<const std::uint64_t>(std::size_t)>& open) const {
  std::vector<Light> lights(places);
  parallelFor(places, 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = open(i);
      lights[i] = {outlook(shares_, row, 0, sky_count_),
                   outlook(shares_, row, sky_count_, shares_.size() - sky_count_)};
    }
  });
  return lights;
}

}  // namespace espalier::sim
