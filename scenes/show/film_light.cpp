#include "scenes/show/film_light.h"

#include <cstdint>
#include <utility>

#include "sim/base/parallel.h"
#include "sim/sweep/sweep.h"

namespace espalier::scenes {
namespace {

constexpr std::int32_t kAll = 1 << 15;  // of the way from one to the other

/// So much of the way, rounded to nearest.
std::uint16_t between(std::uint16_t from, std::uint16_t to, std::int32_t part) {
  const std::int32_t change = (std::int32_t{to} - std::int32_t{from}) * part;
  return static_cast<std::uint16_t>(from + ((change + kAll / 2) >> 15));
}

/// The beginning, the end, and between them what first has so many parts of all that is taken.
std::vector<int> momentsOf(const sim::VoxelBirths& births, int iterations) {
  std::vector<int> moments;
  const std::size_t all = births.takenAfter(iterations);
  for (int k = 0, moment = 0; k <= iterations; ++k) {
    const auto reached = [&] {
      return births.takenAfter(k) * FilmLight::kMoments >= all * static_cast<std::size_t>(moment);
    };
    if (k > 0 && k < iterations && !reached()) continue;
    moments.push_back(k);
    while (moment < FilmLight::kMoments && reached()) ++moment;
  }
  return moments;
}

}  // namespace

FilmLight::FilmLight(const sim::World& world, const sim::Sky& sky, std::optional<sim::RandomSky> random_sky,
                     const sim::VoxelBirths& births, int iterations,
                     std::shared_ptr<const sim::ExposureField> now)
    : world_(world), sky_(sky), random_sky_(random_sky), births_(births) {
  for (const int k : momentsOf(births, iterations)) moments_.push_back({k, nullptr});
  moments_.back().sky = std::move(now);
}

std::shared_ptr<const sim::ExposureField> FilmLight::found(int iterations) const {
  const sim::BitVolume opaque = births_.after(world_.opaque(), iterations);
  if (random_sky_)
    return std::make_shared<const sim::ExposureField>(
        sim::randomExposure(opaque, *random_sky_, sky_.weighting, nullptr));
  return std::make_shared<const sim::ExposureField>(sim::sweepExposure(opaque, sim::receivedBy(sky_)));
}

EarlierWorld FilmLight::after(int iterations) {
  while (next_ + 1 < moments_.size() && moments_[next_].iterations < iterations) {
    if (next_ > 0) moments_[next_ - 1].sky = nullptr;
    ++next_;
  }
  const auto skyOf = [&](Moment& moment) {
    if (!moment.sky) moment.sky = found(moment.iterations);
    return moment.sky;
  };
  EarlierWorld earlier{births_.after(world_.occupied(), iterations), nullptr};
  Moment& to = moments_[next_];
  if (to.iterations <= iterations) {
    earlier.sky = skyOf(to);
    return earlier;
  }
  Moment& from = moments_[next_ - 1];
  const auto taken = [&](int k) { return static_cast<std::int64_t>(births_.takenAfter(k)); };
  const std::int64_t more = taken(iterations) - taken(from.iterations),
                     all = taken(to.iterations) - taken(from.iterations);
  earlier.sky = skyOf(from);
  if (more == 0) return earlier;
  const auto part = static_cast<std::int32_t>((more * kAll + all / 2) / all);
  const std::vector<std::uint16_t>&a = skyOf(from)->values, &b = skyOf(to)->values;
  auto mixed = std::make_shared<sim::ExposureField>();
  mixed->size = world_.frame().size;
  mixed->values.resize(a.size());
  sim::parallelFor(a.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) mixed->values[i] = between(a[i], b[i], part);
  });
  earlier.sky = std::move(mixed);
  return earlier;
}

FilmBounce::FilmBounce(GrowingBounce& growing, const sim::World& world, const sim::VoxelBirths& births,
                       int iterations, std::shared_ptr<const BouncedLight> now)
    : growing_(growing), world_(world), births_(births) {
  for (const int k : momentsOf(births, iterations)) moments_.push_back({k, nullptr});
  moments_.back().light = std::move(now);
}

const std::shared_ptr<const BouncedLight>& FilmBounce::lightAt(Moment& moment) {
  if (!moment.light) moment.light = growing_.when(births_.after(world_.occupied(), moment.iterations));
  return moment.light;
}

std::function<sim::Colour(sim::Vec3, sim::Vec3f)> FilmBounce::after(int iterations) {
  while (next_ + 1 < moments_.size() && moments_[next_].iterations < iterations) {
    if (next_ > 0) moments_[next_ - 1].light = nullptr;
    ++next_;
  }
  const auto to = lightAt(moments_[next_]);
  const sim::Frame frame = world_.frame();
  if (moments_[next_].iterations <= iterations) {
    return [=](sim::Vec3 p_m, sim::Vec3f normal) { return to->at(sim::voxelFromWorld(frame, p_m), normal); };
  }
  const int begins = moments_[next_ - 1].iterations, ends = moments_[next_].iterations;
  const float part = static_cast<float>(iterations - begins) / static_cast<float>(ends - begins);
  return [=, from = lightAt(moments_[next_ - 1])](sim::Vec3 p_m, sim::Vec3f normal) {
    const sim::Vec3 place_vx = sim::voxelFromWorld(frame, p_m);
    return glm::mix(from->at(place_vx, normal), to->at(place_vx, normal), part);
  };
}

}  // namespace espalier::scenes
