#include "sim/grow/state.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/base/byte_sink.h"
#include "sim/base/cbor_writer.h"
#include "sim/base/error.h"
#include "sim/base/provenance.h"

namespace espalier::sim {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "columns are written as they lie in memory");

constexpr std::string_view kTitle = "espalier state ";
constexpr std::string_view kHeader = "espalier state 1\n";
constexpr std::size_t kSum = 16;  // characters of the checksum

// Columns of plain numbers go as their bytes; everything else as CBOR's own types.
template <typename T>
std::vector<T> unpacked(const json& node) {
  const auto& bytes = node.get_binary();
  if (bytes.size() % sizeof(T) != 0) throw InputError("a column is cut short");
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

void write(CborWriter& out, const Columns& columns) {
  out.map(columns.size());
  for (const auto& [name, column] : columns) {
    out.text(name);
    out.array(2);
    out.number(column.index());
    std::visit([&](const auto& values) { out.packed(values); }, column);
  }
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

void write(CborWriter& out, const Plant& plant) {
  const Skeleton& s = plant.skeleton;
  out.map(7);
  out.text("born");
  out.packed(s.born);
  out.text("columns");
  out.map(s.columns.size());
  for (const auto& [name, values] : s.columns) {
    out.text(name);
    out.packed(values);
  }
  out.text("element_numbers");
  std::array<std::int32_t, 3> whole;
  out.bytes(plant.elements.size() * sizeof whole);
  for (const PlacedElement& e : plant.elements) {
    whole = {e.node, e.shape, e.born};
    out.raw(whole.data(), sizeof whole);
  }
  out.text("element_places");
  std::array<double, 14> numbers;
  out.bytes(plant.elements.size() * sizeof numbers);
  for (const PlacedElement& e : plant.elements) {
    numbers = {e.position_vx.x, e.position_vx.y,
               e.position_vx.z, e.x.x,
               e.x.y,           e.x.z,
               e.y.x,           e.y.y,
               e.y.z,           e.z.x,
               e.z.y,           e.z.z,
               e.scale,         static_cast<double>(e.exposure)};
    out.raw(numbers.data(), sizeof numbers);
  }
  out.text("key");
  out.number(plant.key);
  out.text("parent");
  out.packed(s.parent);
  out.text("position_vx");
  out.packed(s.position_vx);
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

void write(CborWriter& out, const std::vector<Attempt>& attempts) {
  out.array(2);
  out.bytes(attempts.size() * 2 * sizeof(Vec3));
  for (const Attempt& a : attempts) {
    for (const Vec3& place : {a.from_vx, a.to_vx}) out.raw(&place, sizeof place);
  }
  out.bytes(attempts.size());
  for (const Attempt& a : attempts) {
    const auto outcome = static_cast<std::uint8_t>(2 * static_cast<int>(a.outcome) + (a.taken ? 1 : 0));
    out.raw(&outcome, 1);
  }
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

/// Voxels that are occupied now and were free in the site, in order.
template <typename Visit>
void forEachGrown(const World& world, const BitVolume& site, Visit visit) {
  const BitVolume& now = world.occupied();
  for (int y = 0; y < now.size().y; ++y) {
    for (int z = 0; z < now.size().z; ++z) {
      for (int w = 0; w < now.rowWords() - 1; ++w) {
        for (std::uint64_t word = now.row(y, z)[w] & ~site.row(y, z)[w]; word != 0; word &= word - 1)
          visit(Voxel(w * BitVolume::kWordBits + std::countr_zero(word), y, z));
      }
    }
  }
}

void writeVoxels(CborWriter& out, const World& world, const BitVolume& site, PartId first) {
  std::size_t count = 0;
  forEachGrown(world, site, [&](Voxel) { ++count; });
  out.array(2);
  std::array<std::int32_t, 4> whole;
  out.bytes(count * sizeof whole);
  forEachGrown(world, site, [&](Voxel v) {
    whole = {v.x, v.y, v.z, world.partAt(v) - first};
    out.raw(whole.data(), sizeof whole);
  });
  std::array<float, 8> numbers;
  out.bytes(count * sizeof numbers);
  forEachGrown(world, site, [&](Voxel v) {
    const Surface s = *world.surfaceAt(v);
    numbers = {s.colour.r, s.colour.g, s.colour.b, s.coverage,
               s.normal.x, s.normal.y, s.normal.z, s.offset_vx};
    out.raw(numbers.data(), sizeof numbers);
  });
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

void write(CborWriter& out, const OutcomeCounts& counts) {
  out.array(counts.size());
  for (const std::uint64_t count : counts) out.number(count);
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

void writeGrowth(CborWriter& out, const Inputs& inputs, const World& world, const BitVolume& site,
                 const Growth& growth) {
  PartId first = static_cast<PartId>(world.parts().size()) + 1;
  for (const Plant& plant : growth.plants) first = std::min(first, plant.stem_part);
  out.map(10);
  out.text("attempts");
  write(out, growth.attempts);
  out.text("commons");
  out.map(growth.commons.size());
  for (const auto& [name, columns] : growth.commons) {
    out.text(name);
    write(out, columns);
  }
  out.text("inputs");
  out.array(inputs.size());
  for (const auto& [name, value] : inputs) {
    out.array(2);
    out.text(name);
    out.text(value);
  }
  out.text("iterations");
  out.number(static_cast<std::uint64_t>(growth.iterations));
  out.text("plants");
  out.array(growth.plants.size());
  for (const Plant& plant : growth.plants) write(out, plant);
  out.text("recorded");
  out.boolean(growth.recorded);
  out.text("size");
  const Voxel size = world.frame().size;
  out.array(3);
  for (const int side : {size.x, size.y, size.z}) out.number(static_cast<std::uint64_t>(side));
  out.text("stands");
  out.array(growth.stands.size());
  for (const Stand& stand : growth.stands) {
    out.array(3);
    out.number(stand.first);
    out.number(stand.count);
    write(out, stand.memory);
  }
  out.text("tallies");
  out.array(growth.tallies.size());
  for (const Tally& tally : growth.tallies) {
    out.array(2);
    write(out, tally.sites);
    write(out, tally.trials);
  }
  out.text("voxels");
  writeVoxels(out, world, site, first);
}

}  // namespace

void writeState(std::ostream& file, const Inputs& inputs, const World& world, const BitVolume& site,
                const Growth& growth) {
  file << kHeader;
  const auto sum_at = file.tellp();
  file << std::string(kSum, '0') << '\n';
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash(XXH3_createState(), XXH3_freeState);
  XXH3_64bits_reset(hash.get());
  ByteSink sink([&](std::string_view bytes) {
    XXH3_64bits_update(hash.get(), bytes.data(), bytes.size());
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
  std::ostream payload(&sink);
  CborWriter out(payload);
  writeGrowth(out, inputs, world, site, growth);
  payload.flush();
  const auto end = file.tellp();
  file.seekp(sum_at);
  file << hexOf(XXH3_64bits_digest(hash.get()));
  file.seekp(end);
}

std::string stateBytes(const Inputs& inputs, const World& world, const BitVolume& site,
                       const Growth& growth) {
  std::ostringstream file(std::ios::binary);
  writeState(file, inputs, world, site, growth);
  return std::move(file).str();
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
  if (bytes.size() < kSum + 1 ||
      hexOf(XXH3_64bits(bytes.data() + kSum + 1, bytes.size() - kSum - 1)) != bytes.substr(0, kSum))
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
