#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scenes/accuracy/certificate.h"

namespace espalier::scenes {

std::string toText(const Certificate& c) {
  std::string text = fmt::format(
      "sky exposure, {} weighting, {} directions, voxels of {:.4g} m; errors in shares of the whole sky\n"
      "walls as high as streets and courts are wide, pits as deep as their radius\n\n",
      sim::nameOf(c.weighting), c.directions, c.voxel_m);
  text += fmt::format("{:<34} {:<20} {:>9} {:>7} {:>7} {:>7} {:>8} {:>7}\n", "shape", "place", "width",
                      "voxels", "truth", "map", "error", "RMS");
  for (const auto& line : c.lines) {
    text += fmt::format("{:<34} {:<20} {:>9} {:>7} {:>7.4f} {:>7.4f} {:>+8.4f} {:>7.4f}\n", line.shape,
                        line.place, line.size_m > 0.0 ? fmt::format("{:.4g} m", line.size_m) : "-",
                        line.voxels > 0 ? fmt::format("{}", line.voxels) : "-", line.truth, line.value,
                        line.error(), line.rms);
  }
  text += fmt::format("all shapes: bias {:+.4f}, RMS {:.4f}\n", c.bias, c.rms);
  if (c.spots) {
    const auto& s = *c.spots;
    text += fmt::format(
        "\nagainst {} rays (Embree) from each of {} points of the scene's triangles, {} weighting:\n"
        "bias {:+.4f}, RMS {:.4f}, median {:.4f}, 95th percentile {:.4f}\n"
        "worst {:+.4f} at ({:.4g}, {:.4g}, {:.4g}) m on {}, {}: {:.4f} instead of {:.4f}\n",
        s.rays, s.points, sim::nameOf(c.weighting), s.bias, s.rms, s.median, s.percentile_95,
        s.worst.value - s.worst.truth, s.worst.at_m.x, s.worst.at_m.y, s.worst.at_m.z, s.worst.object,
        s.worst.region, s.worst.value, s.worst.truth);
    text += fmt::format(
        "{} points in joints, on backs of thin things or outside of the world were left out\n", s.left_out);
  }
  return text;
}

std::string toJson(const Certificate& c) {
  using Json = nlohmann::ordered_json;
  Json json = {{"weighting", sim::nameOf(c.weighting)},
               {"directions", c.directions},
               {"voxel_m", c.voxel_m},
               {"unit", "share of the whole sky"}};
  Json lines = Json::array();
  for (const auto& line : c.lines) {
    lines.push_back({{"shape", line.shape},
                     {"place", line.place},
                     {"width_m", line.size_m},
                     {"width_voxels", line.voxels},
                     {"truth", line.truth},
                     {"map", line.value},
                     {"error", line.error()},
                     {"rms", line.rms},
                     {"worst", line.worst}});
  }
  json["shapes"] = lines;
  json["bias"] = c.bias;
  json["rms"] = c.rms;
  if (c.spots) {
    const auto& s = *c.spots;
    json["rays_on_triangles"] = {{"points", s.points},
                                 {"points_left_out", s.left_out},
                                 {"rays", s.rays},
                                 {"bias", s.bias},
                                 {"rms", s.rms},
                                 {"median", s.median},
                                 {"percentile_95", s.percentile_95},
                                 {"worst",
                                  {{"at_m", {s.worst.at_m.x, s.worst.at_m.y, s.worst.at_m.z}},
                                   {"object", s.worst.object},
                                   {"region", s.worst.region},
                                   {"truth", s.worst.truth},
                                   {"map", s.worst.value}}}};
  }
  return json.dump(2) + "\n";
}

}  // namespace espalier::scenes
