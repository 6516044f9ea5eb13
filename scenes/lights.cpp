#include "scenes/lights.h"

namespace espalier::scenes {
namespace {

sim::SunArc arc(const SunSpec& spec) {
  return {spec.tilt_deg, spec.toward_deg, spec.samples, spec.accuracy_deg};
}

sim::RealSun realSun(const SunSpec& spec) {
  sim::RealSun sun;
  sun.first = spec.firstDay();
  sun.last = spec.dates ? spec.dates->to : sun.first;
  sun.latitude_deg = spec.place->latitude_deg;
  sun.longitude_deg = spec.place->longitude_deg;
  sun.utc_offset_h = spec.place->utc_offset_h;
  sun.from_h = spec.hours.from;
  sun.to_h = spec.hours.to;
  sun.step_min = spec.step_min;
  sun.weighting = spec.weighting;
  sun.north_deg = spec.north_deg;
  sun.within_deg = spec.accuracy_deg;
  return sun;
}

}  // namespace

sim::SkySettings skySettings(const SkySpec& spec) {
  return {spec.weighting, spec.accuracy.value_or(SkySpec::kGrowthError), spec.directions};
}

std::optional<sim::RandomSky> randomSky(const SkySpec& spec, std::uint64_t seed) {
  if (spec.sampling == Sampling::lattice) return std::nullopt;
  return sim::RandomSky{spec.rays, seed};
}

sim::Background backgroundOf(const SkySpec& spec, const std::optional<sim::SkyPicture>& picture,
                             const sim::DirectionSet& sun) {
  using Kind = BackgroundSpec::Kind;
  const auto sky = [&]() -> sim::Background {
    switch (spec.background.kind) {
      case Kind::weighting:
        return sim::backgroundOf(spec.weighting);
      case Kind::uniform:
        return sim::backgroundOf(sim::Weighting::uniform);
      case Kind::cie_overcast:
        return sim::backgroundOf(sim::Weighting::cie_overcast);
      case Kind::gradient:
        return sim::gradient(spec.background.horizon);
      case Kind::picture:
        return sim::pictured(picture.value(), spec.background.turn_deg);
    }
    return sim::backgroundOf(spec.weighting);
  };
  return sim::withBand(sky(), sun, spec.background.sun);
}

sim::SkyTable skyTableOf(const sim::Background& background) {
  return sim::makeSkyTable(9, 36, background);
}

sim::Sun makeSun(const SunSpec& spec) {
  return spec.place ? sim::makeSun(realSun(spec)) : sim::makeSun(arc(spec));
}

render::DaylightShare daylightShare(const Scene& scene) {
  return {static_cast<float>(scene.sky.brightness) * scene.sky.tint,
          sim::Colour(static_cast<float>(scene.sun.brightness))};
}

sim::Vec3 sunDirection(const SunSpec& spec, double hour) {
  return spec.place ? sim::sunDirection(realSun(spec), spec.firstDay(), hour)
                    : sim::sunDirection(arc(spec), hour);
}

sim::Vec3 shadowDirection(const SunSpec& spec) {
  return sunDirection(spec, spec.shadow_hour);
}

}  // namespace espalier::scenes
