#include "scenes/import/line_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include "scenes/clean_text.h"
#include "scenes/import/guarded_file.h"
#include "scenes/import/obj_statements.h"
#include "scenes/import/placing.h"
#include "scenes/problem.h"
#include "sim/base/error.h"
#include "sim/base/hasher.h"
#include "sim/base/random.h"

namespace espalier::scenes {
namespace {

class LinesInObj {
 public:
  LinesInObj(RegionsFrom regions_from, std::string stem)
      : regions_from_(regions_from), region_(std::move(stem)) {}

  LineArt read(std::string_view obj) {
    for (ObjStatements statement(obj); statement.next();) {
      line_ = statement.line();
      const std::string_view keyword = statement.keyword();
      if (keyword == "v") addPlace(statement);
      if (keyword == "l" || keyword == "p") addNumbers(statement, keyword == "l");
      const bool names =
          regions_from_ == RegionsFrom::group ? keyword == "g" || keyword == "o" : keyword == "usemtl";
      if (names && !statement.rest().empty()) region_ = cleanText(std::string(statement.rest()));
    }
    known_.requireAll();
    for (const auto& [from, to, region] : joins_)
      art_.lines.push_back(
          {places_[static_cast<std::size_t>(from - 1)], places_[static_cast<std::size_t>(to - 1)], region});
    return std::move(art_);
  }

 private:
  struct Join {
    std::int64_t from, to;
    std::uint32_t region;
  };

  void addPlace(ObjStatements& statement) {
    sim::Vec3 place;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = statement.takeNumber();
      const auto number = numberOf(word);
      if (!number)
        throw sim::InputError(
            fmt::format("line {}: {} is not a finite number; expected x, y and z", line_, inQuotes(word)));
      place[axis] = static_cast<double>(*number);
    }
    known_.add();
    places_.push_back(place);
    requireFew(places_.size());
  }

  void addNumbers(ObjStatements& statement, bool joined) {
    std::int64_t before = 0;
    std::size_t count = 0;
    for (std::string_view word = statement.takeNumber(); !word.empty(); word = statement.takeNumber()) {
      const std::int64_t vertex = known_.asked(word, line_, joined ? "a line" : "a point");
      if (!joined) before = vertex;
      if (!joined || count > 0) joins_.push_back({before, vertex, numberOfRegion()});
      before = vertex;
      ++count;
      requireFew(joins_.size());
    }
    if (count < (joined ? 2u : 1u))
      throw sim::InputError(fmt::format(
          "line {}: {}", line_, joined ? "a line of fewer than two vertices" : "a point of no vertex"));
  }

  std::uint32_t numberOfRegion() {
    const auto [at, is_new] = numbers_.try_emplace(region_, static_cast<std::uint32_t>(art_.regions.size()));
    if (is_new) art_.regions.push_back(region_);
    return at->second;
  }

  void requireFew(std::size_t count) const {
    if (count > kMostLines)
      throw sim::InputError(fmt::format(
          "line {}: there are more than {} lines or vertices; expected as many at most", line_, kMostLines));
  }

  RegionsFrom regions_from_;
  std::string region_;
  LineArt art_;
  ObjVertices known_;
  std::vector<sim::Vec3> places_;
  std::vector<Join> joins_;
  std::map<std::string, std::uint32_t> numbers_;
  int line_ = 0;
};

void addTriangle(sim::Mesh& mesh, std::array<std::uint32_t, 3> corners, std::uint32_t region) {
  mesh.triangles.push_back(corners);
  mesh.region.push_back(region);
  mesh.material.push_back(0);
}

/// A tube of six sides, closed at its ends.
void addTube(sim::Mesh& mesh, const sim::Line& line, double radius_m) {
  constexpr std::uint32_t kSides = 6;
  const sim::Vec3 way = glm::normalize(line.to_m - line.from_m), u = sim::perpendicular(way),
                  v = glm::cross(way, u);
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (const sim::Vec3 end : {line.from_m, line.to_m}) {
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const auto at = sim::unitCircle(static_cast<double>(side) / kSides);
      mesh.vertices_m.push_back(end + radius_m * (at.x * u + at.y * v));
    }
  }
  for (std::uint32_t side = 0; side < kSides; ++side) {
    const std::uint32_t a = first + side, b = first + (side + 1) % kSides;
    addTriangle(mesh, {a, b, b + kSides}, line.region);
    addTriangle(mesh, {a, b + kSides, a + kSides}, line.region);
    if (side < 2) continue;
    addTriangle(mesh, {first, first + side, first + side - 1}, line.region);
    addTriangle(mesh, {first + kSides, first + kSides + side - 1, first + kSides + side}, line.region);
  }
}

/// An octahedron.
void addCorner(sim::Mesh& mesh, const sim::Line& point, double radius_m) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {radius_m, -radius_m}) {
      mesh.vertices_m.push_back(point.from_m);
      mesh.vertices_m.back()[axis] += side;
    }
  }
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const std::uint32_t x = first + (octant & 1), y = first + 2 + (octant >> 1 & 1),
                        z = first + 4 + (octant >> 2);
    const bool turned = ((octant ^ octant >> 1 ^ octant >> 2) & 1u) != 0;
    addTriangle(mesh, turned ? std::array{x, z, y} : std::array{x, y, z}, point.region);
  }
}

}  // namespace

LineArt linesIn(std::string_view obj, RegionsFrom regions_from, const std::string& stem) {
  return LinesInObj(regions_from, stem).read(obj);
}

std::optional<LineArt> readLineFile(const std::filesystem::path& file, RegionsFrom regions_from,
                                    sim::InputFile& read) {
  try {
    sizeOfFile(file, "mesh");
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (!in) throw sim::InputError("cannot be read");
    for (const char* const face : {"\nf ", "\nf\t"}) {  // of most files this is all that is asked
      if (bytes.find(face) != std::string::npos) return std::nullopt;
    }
    for (ObjStatements statement(bytes); statement.next();) {
      if (statement.keyword() == "f") return std::nullopt;
    }
    LineArt art = linesIn(bytes, regions_from, file.stem().string());
    if (art.lines.empty()) return std::nullopt;
    read = {cleanText(file.filename().string()), "mesh", sim::hashOf(bytes)};
    return art;
  } catch (const sim::InputError& error) {
    throw sim::InputError(fmt::format("{}: {}", file.string(), cleanText(error.what())));
  }
}

LineArt linesOf(const SceneMesh& spec) {
  LineArt art{{spec.name}, {}};
  for (const auto& places : spec.lines_m) {
    if (places.size() == 1) art.lines.push_back({places[0], places[0], 0});
    for (std::size_t i = 1; i < places.size(); ++i) art.lines.push_back({places[i - 1], places[i], 0});
  }
  return art;
}

sim::TiledMesh lineShape(const SceneMesh& spec, LineArt art) {
  const Placing placing(spec.placement);
  sim::TiledMesh tiled;
  tiled.mesh.name = spec.name;
  tiled.mesh.regions = std::move(art.regions);
  tiled.mesh.materials = {{.name = spec.name, .colour = spec.colour.value_or(sim::Material{}.colour)}};
  if (spec.alpha) sim::setOpacity(tiled.mesh.materials.front(), *spec.alpha);
  for (sim::Line& line : art.lines) {
    line.from_m = placing.point(line.from_m);
    line.to_m = placing.point(line.to_m);
    if (!std::isfinite(glm::length(line.from_m)) || !std::isfinite(glm::length(line.to_m)))
      throw sim::InputError(fmt::format("mesh '{}': a line's end is not finite", spec.name));
    if (glm::distance(line.from_m, line.to_m) > 1e-9 * spec.thickness_m)
      addTube(tiled.mesh, line, 0.5 * spec.thickness_m);
    else
      addCorner(tiled.mesh, line, 0.5 * spec.thickness_m);
  }
  tiled.lines = std::move(art.lines);
  tiled.guide = spec.guide;
  return tiled;
}

}  // namespace espalier::scenes
