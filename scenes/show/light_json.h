#pragma once
// Heavy: nlohmann/json. Include from .cpp files alone.
#include <nlohmann/json.hpp>

#include "sim/light/lighting.h"

namespace espalier::scenes {

/// What the numbers of a light are, for reports and tables.
inline nlohmann::ordered_json lightJson(const sim::LightAbout& about) {
  nlohmann::ordered_json json = {
      {"sky", about.sky}, {"weighting", about.weighting}, {"directions", about.directions}};
  if (about.standard_error > 0.0) json["standard_error"] = about.standard_error;
  if (!about.sun.empty()) {
    json["sun"] = about.sun;
    json["sun_directions"] = about.sun_directions;
    json["sun_error_deg"] = about.sun_error_deg;
    json["sun_hours"] = about.sun_hours;
  }
  if (!about.interreflection.empty()) json["interreflection"] = about.interreflection;
  json["voxel_m"] = about.voxel_m;
  return json;
}

}  // namespace espalier::scenes
