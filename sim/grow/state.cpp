#include "sim/grow/state.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "sim/base/error.h"
#include "sim/base/voxel_set.h"

namespace espalier::sim {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "columns are written as they lie in memory");

constexpr std::string_view kTitle = "espalier state ";
constexpr std::string_view kHeader = "espalier state 1\n";
constexpr std::size_t kSum = 16;  // characters of the checksum

std::string checksum(std::string_view payload) {
  return fmt::format("{:016x}", XXH3_64bits(payload.data(), payload.size()));
}

// Columns of plain numbers go as their bytes; everything else as CBOR's own types.
template <typename T>
json packed(const std::vector<T>& values) {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(values.data());
  return json::binary(std::vector<std::uint8_t>(bytes, bytes + values.size() * sizeof(T)));
}

template <typename T>
std::vector<T> unpacked(const json& node) {
  const auto& bytes = node.get_binary();
  if (bytes.size() % sizeof(T) != 0) throw InputError("a column is cut short");
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

json packed(const Columns& columns) {
  json all = json::object();
  for (const auto& [name, column] : columns)
    all[name] = {column.index(), std::visit([](const auto& values) { return packed(values); }, column)};
  return all;
}

template <std::size_t... I>
Column columnOf(std::size_t index, const json& data, std::index_sequence<I...>) {
  Column column;
  const bool known =
      ((index == I &&
        (column = unpacked<typename std::variant_alternative_t<I, Column>::value_type>(data), true)) ||
       ...);
  if (!known) throw InputError("a column of a kind that is not known");
  return column;
}

Columns columnsOf(const json& node) {
  Columns columns;
  for (const auto& [name, value] : node.items()) {
    columns[name] = columnOf(value.at(0).get<std::size_t>(), value.at(1),
                             std::make_index_sequence<std::variant_size_v<Column>>());
  }
  return columns;
}

json plantOf(const Plant& plant) {
  const Skeleton& s = plant.skeleton;
  json columns = json::object();
  for (const auto& [name, values] : s.columns) columns[name] = packed(values);
  std::vector<std::int32_t> whole;
  std::vector<double> numbers;
  for (const PlacedElement& e : plant.elements) {
    whole.insert(whole.end(), {e.node, e.shape, e.born});
    for (const Vec3& v : {e.position_vx, e.x, e.y, e.z}) numbers.insert(numbers.end(), {v.x, v.y, v.z});
    numbers.insert(numbers.end(), {e.scale, static_cast<double>(e.exposure)});
  }
  return {{"key", plant.key},
          {"parent", packed(s.parent)},
          {"position_vx", packed(s.position_vx)},
          {"born", packed(s.born)},
          {"columns", columns},
          {"element_numbers", packed(whole)},
          {"element_places", packed(numbers)}};
}

Plant plantFrom(const json& node) {
  Plant plant;
  plant.key = node.at("key").get<std::uint64_t>();
  Skeleton& s = plant.skeleton;
  s.parent = unpacked<NodeId>(node.at("parent"));
  s.position_vx = unpacked<Vec3>(node.at("position_vx"));
  s.born = unpacked<std::int32_t>(node.at("born"));
  for (const auto& [name, values] : node.at("columns").items()) s.columns[name] = unpacked<float>(values);
  const auto whole = unpacked<std::int32_t>(node.at("element_numbers"));
  const auto numbers = unpacked<double>(node.at("element_places"));
  if (whole.size() % 3 != 0 || numbers.size() != whole.size() / 3 * 14)
    throw InputError("its elements do not fit each other");
  for (std::size_t i = 0; i < whole.size() / 3; ++i) {
    const double* const n = numbers.data() + 14 * i;
    const auto vec = [&](std::size_t k) { return Vec3(n[k], n[k + 1], n[k + 2]); };
    plant.elements.push_back({whole[3 * i], whole[3 * i + 1], vec(0), vec(3), vec(6), vec(9), n[12],
                              static_cast<float>(n[13]), whole[3 * i + 2]});
  }
  return plant;
}

json attemptsOf(const std::vector<Attempt>& attempts) {
  std::vector<Vec3> places;
  std::vector<std::uint8_t> outcomes;
  for (const Attempt& a : attempts) {
    places.insert(places.end(), {a.from_vx, a.to_vx});
    outcomes.push_back(static_cast<std::uint8_t>(2 * static_cast<int>(a.outcome) + (a.taken ? 1 : 0)));
  }
  return {packed(places), packed(outcomes)};
}

std::vector<Attempt> attemptsFrom(const json& node) {
  const auto places = unpacked<Vec3>(node.at(0));
  const auto outcomes = unpacked<std::uint8_t>(node.at(1));
  if (places.size() != 2 * outcomes.size()) throw InputError("its trials do not fit each other");
  std::vector<Attempt> attempts;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (outcomes[i] / 2u >= kOutcomes) throw InputError("a trial with an outcome that is not known");
    attempts.push_back(
        {places[2 * i], places[2 * i + 1], static_cast<Outcome>(outcomes[i] / 2), outcomes[i] % 2 == 1});
  }
  return attempts;
}

json voxelsOf(const World& world, const BitVolume& site, PartId first) {
  BitVolume grown = world.occupied();
  for (int y = 0; y < grown.size().y; ++y) {
    for (int z = 0; z < grown.size().z; ++z) {
      for (int w = 0; w < grown.rowWords(); ++w) grown.row(y, z)[w] &= ~site.row(y, z)[w];
    }
  }
  std::vector<std::int32_t> whole;
  std::vector<float> numbers;
  for (const Voxel v : VoxelSet(std::move(grown)).voxels()) {
    const Surface s = *world.surfaceAt(v);
    whole.insert(whole.end(), {v.x, v.y, v.z, s.part - first});
    numbers.insert(numbers.end(), {s.colour.r, s.colour.g, s.colour.b, s.coverage, s.normal.x, s.normal.y,
                                   s.normal.z, s.offset_vx});
  }
  return {packed(whole), packed(numbers)};
}

std::vector<TiledVoxel> voxelsFrom(const json& node) {
  const auto whole = unpacked<std::int32_t>(node.at(0));
  const auto numbers = unpacked<float>(node.at(1));
  if (whole.size() % 4 != 0 || numbers.size() != whole.size() * 2)
    throw InputError("its voxels do not fit each other");
  std::vector<TiledVoxel> voxels;
  for (std::size_t i = 0; i < whole.size() / 4; ++i) {
    const std::int32_t* const v = whole.data() + 4 * i;
    const float* const n = numbers.data() + 8 * i;
    voxels.push_back({{v[0], v[1], v[2]}, {v[3], {n[0], n[1], n[2]}, n[3], {n[4], n[5], n[6]}, n[7]}});
  }
  return voxels;
}

json countsOf(const OutcomeCounts& counts) {
  return std::vector<std::uint64_t>(counts.begin(), counts.end());
}

OutcomeCounts countsFrom(const json& node) {
  if (node.size() != kOutcomes) throw InputError("it counts other outcomes than there are");
  OutcomeCounts counts{};
  for (std::size_t k = 0; k < kOutcomes; ++k) counts[k] = node.at(k).get<std::uint64_t>();
  return counts;
}

State stateFrom(const json& root) {
  State state;
  state.inputs = root.at("inputs").get<Inputs>();
  Growth& growth = state.growth;
  growth.iterations = root.at("iterations").get<int>();
  for (const json& plant : root.at("plants")) growth.plants.push_back(plantFrom(plant));
  for (const json& tally : root.at("tallies"))
    growth.tallies.push_back({countsFrom(tally.at(0)), countsFrom(tally.at(1))});
  for (const json& stand : root.at("stands")) {
    growth.stands.push_back(
        {stand.at(0).get<std::size_t>(), stand.at(1).get<std::size_t>(), columnsOf(stand.at(2))});
  }
  for (const auto& [name, columns] : root.at("commons").items()) growth.commons[name] = columnsOf(columns);
  growth.recorded = root.at("recorded").get<bool>();
  growth.attempts = attemptsFrom(root.at("attempts"));
  const auto size = root.at("size").get<std::array<int, 3>>();
  state.size = {size[0], size[1], size[2]};
  state.voxels = voxelsFrom(root.at("voxels"));
  return state;
}

}  // namespace

std::string stateBytes(const Inputs& inputs, const World& world, const BitVolume& site,
                       const Growth& growth) {
  PartId first = static_cast<PartId>(world.parts().size()) + 1;
  for (const Plant& plant : growth.plants) first = std::min(first, plant.stem_part);
  json root = {{"inputs", inputs},
               {"iterations", growth.iterations},
               {"plants", json::array()},
               {"tallies", json::array()},
               {"stands", json::array()},
               {"commons", json::object()},
               {"recorded", growth.recorded},
               {"attempts", attemptsOf(growth.attempts)},
               {"size", {world.frame().size.x, world.frame().size.y, world.frame().size.z}},
               {"voxels", voxelsOf(world, site, first)}};
  for (const Plant& plant : growth.plants) root["plants"].push_back(plantOf(plant));
  for (const Tally& tally : growth.tallies)
    root["tallies"].push_back({countsOf(tally.sites), countsOf(tally.trials)});
  for (const Stand& stand : growth.stands)
    root["stands"].push_back({stand.first, stand.count, packed(stand.memory)});
  for (const auto& [name, columns] : growth.commons) root["commons"][name] = packed(columns);
  std::string payload;
  json::to_cbor(root, payload);
  return std::string(kHeader) + checksum(payload) + "\n" + payload;
}

namespace {

/// The number in a state's first line; empty where the bytes do not begin with such a line.
std::string_view versionOf(std::string_view bytes) {
  if (!bytes.starts_with(kTitle)) return {};
  bytes.remove_prefix(kTitle.size());
  const auto end = bytes.find_first_not_of("0123456789");
  return end != bytes.npos && bytes[end] == '\n' ? bytes.substr(0, end) : std::string_view();
}

}  // namespace

State readState(std::string_view bytes, const std::string& file) {
  const auto fail = [&](const std::string& what) { return InputError(fmt::format("{}: {}", file, what)); };
  const std::string_view version = versionOf(bytes);
  if (version.empty()) throw fail("this is no saved state of espalier");
  if (!bytes.starts_with(kHeader)) {
    throw fail(fmt::format("a state of version {}; expected version 1, the only one that this program knows",
                           version));
  }
  bytes.remove_prefix(kHeader.size());
  if (bytes.size() < kSum + 1 || checksum(bytes.substr(kSum + 1)) != bytes.substr(0, kSum))
    throw fail("the state is damaged (its checksum does not fit): it was cut short or changed");
  bytes.remove_prefix(kSum + 1);
  try {
    return stateFrom(json::from_cbor(bytes.begin(), bytes.end()));
  } catch (const json::exception& error) {
    throw fail(fmt::format("the state is damaged ({})", error.what()));
  } catch (const InputError& error) {
    throw fail(fmt::format("the state is damaged: {}", error.what()));
  }
}

}  // namespace espalier::sim
