#include "render/files/skeleton_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "render/model/radii.h"

namespace espalier::render {
namespace {

using Json = nlohmann::ordered_json;
/// Numbers of single precision, which are shortest as such.
using FloatJson =
    nlohmann::basic_json<std::map, std::vector, std::string, bool, std::int64_t, std::uint64_t, float>;

template <class Any>
std::string text(const Any& json) {
  return json.dump(-1, ' ', false, Any::error_handler_t::replace);
}

/// A list of what `entry` gives of each node, some thousands at a time.
template <class Any, class Entry>
void writeColumn(std::ostream& file, const char* before, std::string_view name, std::size_t count,
                 Entry entry) {
  constexpr std::size_t kAtATime = 4096;
  file << before << text(Json(name)) << ":[";
  for (std::size_t begin = 0; begin < count; begin += kAtATime) {
    Any part = Any::array();
    for (std::size_t n = begin; n < std::min(count, begin + kAtATime); ++n) part.push_back(entry(n));
    const std::string brackets = text(part);
    if (begin > 0) file << ',';
    file << std::string_view(brackets).substr(1, brackets.size() - 2);
  }
  file << ']';
}

void writePlant(std::ostream& file, const sim::Plant& plant, const sim::Frame& frame) {
  const sim::Skeleton& s = plant.skeleton;
  const std::size_t count = s.parent.size();
  const std::vector<float> radii_vx = stemRadii(s, plant.girth);
  file << "{\"name\":" << text(Json(plant.name));
  writeColumn<Json>(file, ",\n ", "parent", count, [&](std::size_t n) { return s.parent[n]; });
  writeColumn<Json>(file, ",\n ", "position_m", count, [&](std::size_t n) {
    const sim::Vec3 at_m = sim::worldFromVoxel(frame, s.position_vx[n]);
    return std::array{at_m.x, at_m.y, at_m.z};
  });
  writeColumn<FloatJson>(file, ",\n ", "radius_m", count, [&](std::size_t n) {
    return static_cast<float>(static_cast<double>(radii_vx[n]) * frame.voxel_m);
  });
  writeColumn<Json>(file, ",\n ", "born", count, [&](std::size_t n) { return s.born[n]; });
  file << ",\n \"columns\":{";
  const char* before = "\n  ";
  for (const auto& [name, values] : s.columns) {
    writeColumn<FloatJson>(file, before, name, count,
                           [&values = values](std::size_t n) { return values[n]; });
    before = ",\n  ";
  }
  file << "}}";
}

}  // namespace

void writeSkeletons(std::ostream& file, std::span<const sim::Plant> plants, const sim::Frame& frame,
                    const sim::Provenance& made_by) {
  Json inputs = Json::array();
  for (const sim::InputFile& input : made_by.inputs)
    inputs.push_back({{"file", input.name}, {"kind", input.kind}, {"xxh3", sim::hexOf(input.hash)}});
  file << "{\"espalier\":\"skeleton/1\",\n\"software\":" << text(Json(made_by.software))
       << ",\n\"seed\":" << made_by.seed << ",\n\"inputs\":" << text(inputs)
       << ",\n\"unit\":\"m\",\n\"up\":\"y\",\n\"plants\":[";
  for (std::size_t i = 0; i < plants.size(); ++i) {
    file << (i > 0 ? ",\n" : "\n");
    writePlant(file, plants[i], frame);
  }
  file << "\n]}\n";
}

}  // namespace espalier::render
