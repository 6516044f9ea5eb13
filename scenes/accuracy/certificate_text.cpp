#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scenes/accuracy/certificate.h"

namespace espalier::scenes {

std::string inShort(const Certificate& c) {
  if (!c.spots) return "";
  const auto& s = *c.spots;
  std::string text = fmt::format(
      "error of sky_exposure, {} weighting, at {} points of these surfaces by {} rays (Embree) from each:\n"
      "  bias {:+.4f}, RMS {:.4f}, half within {:.4f}, 95% within {:.4f}\n",
      sim::nameOf(c.weighting), s.points, s.rays, s.bias, s.rms, s.median, s.percentile_95);
  if (s.on_faces == 0)
    return text + "  none of them on a face as wide as a voxel; smaller voxels would help\n";
  text += fmt::format(
      "  on faces ({} points) RMS {:.4f}, on average {:.4f}: {} directions make {:.4f}, voxels of {:.4g} m "
      "{:.4f}; ",
      s.on_faces, s.rms_on_faces, s.size_on_faces, c.directions, s.size_of_directions, c.voxel_m,
      s.size_of_voxels);
  constexpr double kClearly = 1.5;
  const char* const voxels = "smaller voxels would help most\n";
  if (c.directions >= sim::kMostSkyDirections || s.size_of_voxels > kClearly * s.size_of_directions)
    return text + voxels;
  return text + (s.size_of_directions > kClearly * s.size_of_voxels
                     ? "a finer sky.accuracy would help most\n"
                     : "smaller voxels and a finer sky.accuracy would help alike\n");
}

std::string toText(const Certificate& c) {
  std::string text = inShort(c);
  if (c.spots) {
    const auto& s = *c.spots;
    text += fmt::format(
        "  worst {:+.4f} at ({:.4g}, {:.4g}, {:.4g}) m on {}, {}: {:.4f} instead of {:.4f}\n"
        "  {} points inside of solids or outside of the world were left out\n",
        s.worst.value - s.worst.truth, s.worst.at_m.x, s.worst.at_m.y, s.worst.at_m.z, s.worst.object,
        s.worst.region, s.worst.value, s.worst.truth, s.left_out);
  }
  if (c.lines.empty()) return text;
  text += fmt::format(
      "{}known shapes of such voxels under such a sky, {} weighting, {} directions, voxels of {:.4g} m;\n"
      "errors in shares of the whole sky\n"
      "walls as high as streets and courts are wide, pits as deep as their radius\n\n",
      text.empty() ? "" : "\n", sim::nameOf(c.weighting), c.directions, c.voxel_m);
  text += fmt::format("{:<34} {:<20} {:>9} {:>7} {:>7} {:>7} {:>8} {:>7}\n", "shape", "place", "width",
                      "voxels", "truth", "map", "error", "RMS");
  for (const auto& line : c.lines) {
    text += fmt::format("{:<34} {:<20} {:>9} {:>7} {:>7.4f} {:>7.4f} {:>+8.4f} {:>7.4f}\n", line.shape,
                        line.place, line.size_m > 0.0 ? fmt::format("{:.4g} m", line.size_m) : "-",
                        line.voxels > 0 ? fmt::format("{}", line.voxels) : "-", line.truth, line.value,
                        line.error(), line.rms);
  }
  return text + fmt::format("all shapes: bias {:+.4f}, RMS {:.4f}\n", c.bias, c.rms);
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
  if (!lines.empty()) json["known_shapes"] = {{"bias", c.bias}, {"rms", c.rms}, {"lines", lines}};
  if (c.spots) {
    const auto& s = *c.spots;
    json["rays_on_triangles"] = {{"points", s.points},
                                 {"points_left_out", s.left_out},
                                 {"rays", s.rays},
                                 {"bias", s.bias},
                                 {"rms", s.rms},
                                 {"median", s.median},
                                 {"percentile_95", s.percentile_95},
                                 {"points_on_faces", s.on_faces},
                                 {"rms_on_faces", s.rms_on_faces},
                                 {"mean_size_on_faces", s.size_on_faces},
                                 {"mean_size_of_directions", s.size_of_directions},
                                 {"mean_size_of_voxels", s.size_of_voxels},
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
