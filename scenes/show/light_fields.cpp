#include "scenes/show/light_fields.h"

#include <memory>

#include "scenes/show/light_texts.h"

namespace espalier::scenes {
namespace {

using render::VdbField;
using render::VdbPart;
using Numbers = std::vector<VdbPart<float>>;

constexpr const char* kSkyMeaning = "what a surface receives of the sky by its own normal; open ground: 1";
constexpr const char* kSunMeaning = "weighted share of the sun's way that a surface sees";

VdbPart<float> onSurfaces(const sim::Lighting& light, const sim::Received& received) {
  return {light.where.get(), [&received](sim::Voxel, std::size_t n) { return received.values[n]; }};
}

VdbPart<float> inSpace(const sim::VoxelSet& where, const sim::ExposureField& field, double scale = 1.0) {
  return {&where, [&field, scale = static_cast<float>(scale)](sim::Voxel v, std::size_t) {
            return scale * field.at(v);
          }};
}

}  // namespace

std::vector<VdbField> worldFields(const sim::Lighting& light, const sim::VoxelSet& around) {
  const auto field = [&](const char* name, const char* description, const sim::Received& received,
                         const sim::ExposureField& space) {
    const auto gaps = std::make_shared<const std::vector<float>>(light.ofGaps(received));
    return VdbField{name, description, "1",
                    Numbers{onSurfaces(light, received),
                            {light.gaps.get(), [gaps](sim::Voxel, std::size_t n) { return (*gaps)[n]; }},
                            inSpace(around, space)},
                    texts(light.about)};
  };
  return {field("sun_exposure", "weighted share of the sun's way in sight", light.sun, *light.space_sun),
          field("sky_exposure",
                "what is received of the sky: by surfaces by their normals, in free space as by level ground",
                light.sky, *light.space_sky)};
}

std::vector<VdbField> exposureFields(const sim::Lighting& light, const sim::VoxelSet* space) {
  const bool sun = !light.about.sun.empty();
  const auto surfaces = [&](auto value) {
    return std::vector{VdbPart<decltype(value(std::size_t{}))>{
        light.where.get(), [value](sim::Voxel, std::size_t n) { return value(n); }}};
  };
  std::vector<VdbField> fields;
  const auto add = [&](const char* name, const char* description, const char* unit, auto parts) {
    fields.push_back({name, description, unit, std::move(parts), texts(light.about)});
  };
  add("sky_exposure", kSkyMeaning, "1", Numbers{onSurfaces(light, light.sky)});
  if (sun) {
    add("sun_exposure", kSunMeaning, "1", Numbers{onSurfaces(light, light.sun)});
    add("sun_hours", "direct sun", "hours a day", Numbers{onSurfaces(light, light.sun_hours)});
  }
  add("brightest", "unit vector to the middle of the sky in sight; zero where none is", "1",
      surfaces([&light](std::size_t n) { return light.brightest[n]; }));
  add("normal", "mean surface normal", "1",
      surfaces([&light](std::size_t n) { return light.surfaces[n].surface.normal; }));
  add("part", "number of the part that the surface belongs to, as listed in the file's metadata", "1",
      surfaces([&light](std::size_t n) { return light.surfaces[n].surface.part; }));
  if (space) {
    add("space_sky_exposure", "what level ground would receive of the sky here", "1",
        Numbers{inSpace(*space, *light.space_sky)});
    if (sun) {
      add("space_sun_exposure", "weighted share of the sun's way in sight from here", "1",
          Numbers{inSpace(*space, *light.space_sun)});
      add("space_sun_hours", "direct sun here", "hours a day",
          Numbers{inSpace(*space, *light.space_hours, light.about.sun_hours)});
    }
  }
  return fields;
}

}  // namespace espalier::scenes
