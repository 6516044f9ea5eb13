#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scenes/clean_text.h"
#include "scenes/job/inspect.h"
#include "sim/base/counted.h"

namespace espalier::scenes {
namespace {

using Json = nlohmann::ordered_json;

/// Nobody reads more parts than that.
constexpr std::size_t kMostParts = 12;

std::string_view nameOf(Body body) {
  switch (body) {
    case Body::solid:
      return "solid";
    case Body::inside_out:
      return "solid, inside out";
    case Body::open:
      return "wide open";
    case Body::sheet:
      return "sheet";
  }
  return "";
}

/// Of an open body the sign still says whether its faces look outwards.
std::string bodyText(double winding) {
  const Body body = bodyOf(winding);
  return fmt::format("{}{}", nameOf(body), body == Body::open && winding < 0.0 ? ", inside out" : "");
}

std::string bodyText(const std::optional<double>& winding) {
  return winding ? bodyText(*winding) : "not looked at";
}

/// A mesh's own squares in square metres.
double squareMetres(const Inspected& mesh) {
  const double own = mesh.shape.longest();
  const sim::Vec3 size_m = mesh.high_m - mesh.low_m;
  const double metres = std::max({size_m.x, size_m.y, size_m.z}) / own;
  return metres * metres;
}

std::string areaText(const Inspected& mesh, double area) {
  return fmt::format("{:.3g} m2", area * squareMetres(mesh));
}

/// Parts with their areas, the first few in the order given.
template <class Part, class Line>
std::string listing(std::string_view title, const std::vector<Part>& parts, Line line) {
  std::string text = fmt::format("  {}:\n", title);
  for (std::size_t i = 0; i < std::min(parts.size(), kMostParts); ++i)
    text += fmt::format("    {}\n", line(parts[i]));
  if (parts.size() > kMostParts) text += fmt::format("    and {} more\n", parts.size() - kMostParts);
  return text;
}

/// What is wrong with the surface, or that nothing is.
std::string soundness(const Inspected& mesh) {
  const Surface& s = mesh.surface;
  std::vector<std::string> faults;
  if (s.open_edges > 0)
    faults.push_back(fmt::format("{} in {}", sim::counted(s.open_edges, "open edge", "open edges"),
                                 sim::counted(s.rims, "rim", "rims")));
  if (s.crowded_edges > 0)
    faults.push_back(sim::counted(s.crowded_edges, "edge", "edges") + " with three triangles or more");
  if (s.flipped > 0)
    faults.push_back(sim::counted(s.flipped, "triangle looks", "triangles look") +
                     " another way than their neighbours");
  if (s.duplicates > 0)
    faults.push_back(sim::counted(s.duplicates, "triangle lies", "triangles lie") + " on another");
  if (mesh.degenerate > 0)
    faults.push_back(sim::counted(mesh.degenerate, "triangle has", "triangles have") +
                     " no area and are left out");
  if (faults.empty()) return "closed, without a fault";
  std::string text;
  for (const std::string& fault : faults) text += (text.empty() ? "" : "; ") + fault;
  return text;
}

/// Numbers of files are read as floats by some readers, which have 7 digits.
std::string placeText(const Inspected& mesh) {
  constexpr double kFloat = 6e-8, kNoticed = 1e-3;
  const double off_m = kFloat * mesh.from_origin_m;
  std::string text = fmt::format(
      "  place: {} m from the origin; {}", inDigits(mesh.from_origin_m),
      mesh.from_origin_m > kFarthest_m ? "farther than a scene reaches" : "translate brings it there");
  if (off_m > kNoticed * glm::length(mesh.high_m - mesh.low_m)) {
    text += fmt::format(
        ". So far out its corners may be off by {:.1g} m: better move it in the program that it "
        "comes from",
        off_m);
  }
  return text + "\n";
}

/// What "body" means for who writes the scene.
std::string bodyAdvice(double winding) {
  switch (bodyOf(winding)) {
    case Body::solid:
      return "solid: true can fill it";
    case Body::inside_out:
      return "its faces look inwards and are turned to the light; solid: true can fill it";
    case Body::open:
      return "solid: true would guess where its inside ends";
    case Body::sheet:
      return "it has no inside to fill";
  }
  return "";
}

Json jsonOf(const Inspected& mesh, const SurfacePart& part) {
  Json json;
  if (!part.name.empty()) json["name"] = cleanText(part.name);
  json["triangles"] = part.triangles;
  json["area_m2"] = part.area * squareMetres(mesh);
  if (part.winding) {
    json["winding"] = *part.winding;
    json["body"] = bodyText(*part.winding);
  }
  return json;
}

Json jsonOf(const sim::Vec3& v) {
  return Json::array({v.x, v.y, v.z});
}

Json jsonOf(const Inspected& mesh) {
  const Surface& s = mesh.surface;
  Json json{
      {"file", cleanText(mesh.file.string())},
      {"triangles", mesh.triangles},
      {"numbers", {{"low", jsonOf(mesh.shape.low)}, {"high", jsonOf(mesh.shape.high)}}},
      {"unit", {{"unit", nameOf(mesh.unit.unit)}, {"why", mesh.unit.why}}},
      {"up", {{"up", mesh.up.up == UpAxis::z ? "z" : "y"}, {"sure", mesh.up.sure}, {"why", mesh.up.why}}},
      {"placed_m", {{"low", jsonOf(mesh.low_m)}, {"high", jsonOf(mesh.high_m)}}},
      {"surface",
       {{"corners", s.corners},
        {"open_edges", s.open_edges},
        {"rims", s.rims},
        {"crowded_edges", s.crowded_edges},
        {"flipped", s.flipped},
        {"duplicates", s.duplicates},
        {"degenerate", mesh.degenerate},
        {"winding", s.winding},
        {"body", bodyText(s.winding)},
        {"pieces", s.pieces.size()}}},
      {"regions_from", mesh.regions == RegionsFrom::material ? "material" : "group"},
      {"regions", Json::array()},
      {"materials", Json::array()},
      {"largest_pieces", Json::array()},
      {"warnings", Json::array()}};
  for (const SurfacePart& region : s.regions) json["regions"].push_back(jsonOf(mesh, region));
  for (const auto& [name, area] : mesh.materials)
    json["materials"].push_back({{"name", cleanText(name)}, {"area_m2", area * squareMetres(mesh)}});
  for (std::size_t i = 0; i < std::min(s.pieces.size(), kMostParts); ++i)
    json["largest_pieces"].push_back(jsonOf(mesh, s.pieces[i]));
  for (const Problem& warning : mesh.warnings) json["warnings"].push_back(format(warning));
  return json;
}

}  // namespace

std::string toText(const Inspected& mesh) {
  const Surface& s = mesh.surface;
  const auto part = [&](const SurfacePart& of) {
    return fmt::format("{}{}, {}, {}", of.name.empty() ? "" : inQuotes(of.name) + ": ",
                       areaText(mesh, of.area), sim::counted(of.triangles, "triangle", "triangles"),
                       bodyText(of.winding));
  };
  std::string text = fmt::format("{}\n  size: {}, {} at {} places\n", cleanText(mesh.file.string()),
                                 sizeText(mesh.high_m - mesh.low_m),
                                 sim::counted(mesh.triangles, "triangle", "triangles"), s.corners);
  text += fmt::format("  unit: {}, as it looks: {}\n", nameOf(mesh.unit.unit), mesh.unit.why);
  text += fmt::format("  up: {}{}: {}\n", mesh.up.up == UpAxis::z ? "z" : "y",
                      mesh.up.sure ? ", as it looks" : "", mesh.up.why);
  if (mesh.from_origin_m > 0.0) text += placeText(mesh);
  text += fmt::format("  surface: {}\n", soundness(mesh));
  text += fmt::format("  body: {} (winding number {:.2f}: 1 is closed, 0 a sheet); {}\n", bodyText(s.winding),
                      s.winding, bodyAdvice(s.winding));
  if (s.pieces.size() > 1)
    text += listing(fmt::format("{} pieces that do not hang together, the largest first", s.pieces.size()),
                    s.pieces, part);
  text += listing(
      mesh.regions == RegionsFrom::material ? "regions, from its materials" : "regions, from its groups",
      s.regions, part);
  if (mesh.regions == RegionsFrom::group) {
    text += listing("materials", mesh.materials, [&](const auto& material) {
      return fmt::format("{}: {}", inQuotes(material.first), areaText(mesh, material.second));
    });
  }
  for (const Problem& warning : mesh.warnings) text += fmt::format("  warning: {}\n", format(warning));
  return text;
}

std::string toText(const std::vector<VoxelChoice>& choices) {
  std::string text;
  for (const VoxelChoice& choice : choices)
    text += fmt::format("  {}\n", choice.foretold ? toText(*choice.foretold) : choice.refused);
  return text;
}

std::string toJson(const std::vector<Inspected>& meshes, const InScene& scene) {
  Json json{{"meshes", Json::array()}, {"voxels", Json::array()}, {"scene", scene.text}};
  for (const Inspected& mesh : meshes) json["meshes"].push_back(jsonOf(mesh));
  for (const VoxelChoice& choice : scene.choices) {
    Json one{{"voxel_m", choice.voxel_m}};
    if (choice.foretold) {
      const sim::Voxel size = choice.foretold->frame.size;
      one["size"] = {size.x, size.y, size.z};
      one["seconds"] = choice.foretold->seconds;
      one["bytes"] = choice.foretold->bytes;
    } else {
      one["refused"] = choice.refused;
    }
    json["voxels"].push_back(std::move(one));
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace espalier::scenes
