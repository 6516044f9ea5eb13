#include "render/files/vdb.h"

#include <fmt/format.h>
#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>
#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <concepts>
#include <functional>
#include <memory>
#include <sstream>
#include <string_view>
#include <type_traits>

#include "sim/base/byte_sink.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"
#include "sim/world/world_grids.h"

namespace espalier::render {
namespace {

// Magic number (8), file version (4), library version (4 + 4), flag for grid offsets (1), then the id as
// text.
constexpr std::size_t kIdAt = 21, kIdLength = 36;

struct About {
  std::string name;
  std::string description;
  std::string unit;
};

void describe(openvdb::GridBase& grid, const About& about, const sim::Frame& frame) {
  grid.setName(about.name);
  grid.setCreator("Espalier");
  grid.insertMeta("description", openvdb::StringMetadata(about.description));
  grid.insertMeta("unit", openvdb::StringMetadata(about.unit));
  grid.insertMeta("voxel_m", openvdb::DoubleMetadata(frame.voxel_m));
}

/// A grid with this tree, in a world's place.
template <class Tree>
typename openvdb::Grid<Tree>::Ptr shown(const std::shared_ptr<Tree>& tree, const About& about,
                                        const sim::World& world,
                                        openvdb::GridClass grid_class = openvdb::GRID_UNKNOWN) {
  auto result = openvdb::Grid<Tree>::create(tree);
  result->setTransform(world.grids().part->transform().copy());
  result->setGridClass(grid_class);
  describe(*result, about, world.frame());
  return result;
}

/// The scene's voxels, and in the same tree the plants'.
template <class Tree, class ValueOf>
std::shared_ptr<Tree> withPlants(std::shared_ptr<Tree> scene, const sim::World& world, ValueOf valueOf) {
  openvdb::tree::ValueAccessor<Tree> access(*scene);
  world.grids().plants.forEach([&](sim::Voxel v, const sim::Surface& surface) {
    access.setValueOn(sim::coordOf(v), valueOf(surface));
  });
  return scene;
}

constexpr int kLeafSide = 8;

/// The eight voxels of a set from x on, as the bits of a byte; x is a multiple of 8.
std::uint8_t eightOf(const sim::VoxelSet& where, int x, int y, int z) {
  return static_cast<std::uint8_t>(where.bits().row(y, z)[x >> 6] >> (x & 63));
}

/// Makes the leaves that hold voxels of the set, without values.
template <class Tree>
void touchLeaves(Tree& tree, const sim::VoxelSet& where) {
  const sim::Voxel size = where.bits().size();
  openvdb::tree::ValueAccessor<Tree> access(tree);
  std::vector<std::uint64_t> any(static_cast<std::size_t>(where.bits().rowWords() - 1));
  for (int y0 = 0; y0 < size.y; y0 += kLeafSide) {
    sim::throwIfStopped();
    for (int z0 = 0; z0 < size.z; z0 += kLeafSide) {
      std::fill(any.begin(), any.end(), 0u);
      for (int y = y0; y < std::min(size.y, y0 + kLeafSide); ++y) {
        for (int z = z0; z < std::min(size.z, z0 + kLeafSide); ++z) {
          const std::uint64_t* const row = where.bits().row(y, z);
          for (std::size_t w = 0; w < any.size(); ++w) any[w] |= row[w];
        }
      }
      for (int x = 0; x < size.x; x += kLeafSide) {
        if (((any[static_cast<std::size_t>(x) / 64] >> (x % 64)) & 0xffu) != 0) access.touchLeaf({x, y0, z0});
      }
    }
  }
}

float toVdb(float value) {
  return value;
}
/// Many programs read grids of floats and of vectors, and no others. Numbers of parts stay exact.
float toVdb(std::int32_t value) {
  return static_cast<float>(value);
}
openvdb::Vec3f toVdb(sim::Vec3f value) {
  return {value.x, value.y, value.z};
}

template <class Value>
openvdb::GridBase::Ptr gridOf(const std::vector<VdbPart<Value>>& parts, const VdbField& field,
                              const sim::World& world) {
  using Tree = typename openvdb::tree::Tree4<decltype(toVdb(Value{})), 5, 4, 3>::Type;
  const sim::Voxel size = world.frame().size;
  auto grid = openvdb::Grid<Tree>::create();
  if constexpr (std::is_same_v<Value, float>) {
    if (field.elsewhere) {
      grid->setTree(std::make_shared<Tree>(world.grids().part->tree(), 0.0f, *field.elsewhere,
                                           openvdb::TopologyCopy()));
      grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    }
  }
  for (const auto& part : parts) touchLeaves(grid->tree(), *part.where);
  // Not by LeafManager's own loop: ours hears when it shall stop, and sanitizers see what it orders.
  std::vector<typename Tree::LeafNodeType*> leaves;
  grid->tree().getNodes(leaves);
  sim::parallelForEach(leaves.size(), [&](std::size_t i) {
    auto& leaf = *leaves[i];
    const openvdb::Coord low = leaf.origin();
    for (const auto& part : parts) {
      for (int y = low.y(); y < std::min(size.y, low.y() + kLeafSide); ++y) {
        for (int z = low.z(); z < std::min(size.z, low.z() + kLeafSide); ++z) {
          std::uint8_t left = eightOf(*part.where, low.x(), y, z);
          if (left == 0) continue;
          std::size_t number = part.where->number({low.x() + std::countr_zero(left), y, z});
          for (; left != 0; left = static_cast<std::uint8_t>(left & (left - 1))) {
            const sim::Voxel v(low.x() + std::countr_zero(left), y, z);
            leaf.setValueOn({v.x, v.y, v.z}, toVdb(part.value(v, number++)));
          }
        }
      }
    }
  });
  return grid;
}

using MakeGrid = std::function<openvdb::GridBase::Ptr()>;

void addFields(std::vector<MakeGrid>& out, const std::vector<VdbField>& fields, const sim::World& world) {
  const sim::Voxel size = world.frame().size;
  for (const VdbField& field : fields) {
    sim::throwIfStopped();
    std::visit(
        [&](const auto& parts) {
          for (const auto& part : parts) {
            if (part.where->bits().size() != size)
              throw sim::InputError(fmt::format("the field {} has another size than the world", field.name));
          }
        },
        field.parts);
    out.push_back([&field, &world] {
      const auto grid =
          std::visit([&](const auto& parts) { return gridOf(parts, field, world); }, field.parts);
      grid->setTransform(world.grids().part->transform().copy());
      if (std::holds_alternative<std::vector<VdbPart<sim::Vec3f>>>(field.parts))
        grid->setVectorType(field.directions ? openvdb::VEC_COVARIANT_NORMALIZE
                                             : openvdb::VEC_CONTRAVARIANT_RELATIVE);
      describe(*grid, {field.name, field.description, field.unit}, world.frame());
      for (const auto& [name, text] : field.about) grid->insertMeta(name, openvdb::StringMetadata(text));
      return grid;
    });
  }
}

openvdb::MetaMap aboutFile(const sim::World& world, const sim::Provenance& made_by) {
  openvdb::MetaMap file;
  file.insertMeta("creator", openvdb::StringMetadata("Espalier"));
  file.insertMeta("up", openvdb::StringMetadata("+y"));
  file.insertMeta("unit", openvdb::StringMetadata("metres in world space"));
  file.insertMeta("layers", openvdb::Int32Metadata(world.layers()));
  std::string names;
  for (std::size_t i = 0; i < world.parts().size(); ++i) {
    const sim::Part& part = world.parts()[i];
    names += fmt::format("{}\t{}\t{}\n", i + 1, part.object, part.region);
  }
  file.insertMeta("parts", openvdb::StringMetadata(names));
  if (made_by.software.empty()) return file;
  file.insertMeta("software", openvdb::StringMetadata(made_by.software));
  file.insertMeta("seed", openvdb::Int64Metadata(static_cast<std::int64_t>(made_by.seed)));
  file.insertMeta("inputs", openvdb::StringMetadata(sim::listOf(made_by.inputs)));
  return file;
}

/// An id in the shape that OpenVDB expects (a version 8 UUID: its own scheme).
std::string idOf(XXH128_hash_t hash) {
  std::string hex = fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
  hex[12] = '8';
  hex[16] = '8';
  for (const std::size_t at : {8u, 13u, 18u, 23u}) hex.insert(at, 1, '-');
  return hex;
}

/// Passes a file on with zeros for OpenVDB's random id, and puts one in its place that follows from all the
/// bytes around it.
class OwnId {
 public:
  explicit OwnId(std::ostream& file)
      : file_(file),
        begin_(file.tellp()),
        hash_(XXH3_createState(), XXH3_freeState),
        sink_([this](std::string_view bytes) { pass(bytes); }) {
    XXH3_128bits_reset(hash_.get());
  }

  std::streambuf& sink() { return sink_; }
  void finish() {
    const auto end = file_.tellp();
    file_.seekp(begin_ + static_cast<std::streamoff>(kIdAt));
    file_ << idOf(XXH3_128bits_digest(hash_.get()));
    file_.seekp(end);
  }

 private:
  void pass(std::string_view bytes) {
    std::string head;
    if (passed_ < kIdAt + kIdLength) {
      head = bytes;
      for (std::size_t i = 0; i < head.size(); ++i) {
        if (passed_ + i >= kIdAt && passed_ + i < kIdAt + kIdLength) head[i] = '0';
      }
      bytes = head;
    }
    XXH3_128bits_update(hash_.get(), bytes.data(), bytes.size());
    file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    passed_ += bytes.size();
  }

  std::ostream& file_;
  std::ostream::pos_type begin_;
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash_;
  std::size_t passed_ = 0;
  sim::ByteSink sink_;
};

/// Writes what openvdb::io::Stream would, but makes each grid only when its turn has come: of a large world
/// no two of them need to be in memory.
class Writer : public openvdb::io::Archive {
 public:
  void writeAll(std::ostream& file, const std::vector<MakeGrid>& grids, const openvdb::MetaMap& about) const {
    OwnId id(file);
    std::ostream out(&id.sink());
    out.exceptions(std::ios::failbit | std::ios::badbit);
    writeHeader(out, false);
    about.writeMeta(out);
    const auto count = static_cast<std::int32_t>(grids.size());
    out.write(reinterpret_cast<const char*>(&count), sizeof count);
    for (const MakeGrid& make : grids) {
      sim::throwIfStopped();
      const openvdb::GridBase::Ptr grid = make();
      grid->addStatsMetadata();
      grid->insertMeta(openvdb::GridBase::META_FILE_COMPRESSION,
                       openvdb::StringMetadata(openvdb::io::compressionToString(compression())));
      openvdb::io::GridDescriptor descriptor(grid->getName(), grid->type());
      writeGrid(descriptor, grid, out, false);
      openvdb::io::setDataCompression(out, compression());  // a grid's own settings end with it
    }
    out.flush();
    id.finish();
  }
};

std::string inMemory(const std::function<void(std::ostream&)>& write) {
  std::ostringstream out(std::ios::binary);
  write(out);
  return std::move(out).str();
}

}  // namespace

void writeVdb(std::ostream& file, const sim::World& world, const std::vector<VdbField>& fields,
              const sim::Provenance& made_by) {
  openvdb::initialize();
  using openvdb::FloatTree;
  const sim::World::Grids& grids = world.grids();
  const auto fog = openvdb::GRID_FOG_VOLUME;

  std::vector<MakeGrid> out;
  const auto add = [&](auto make) { out.emplace_back(make); };
  add([&] {
    const auto scene =
        std::make_shared<openvdb::FloatTree>(grids.part->tree(), 0.0f, 1.0f, openvdb::TopologyCopy());
    return shown(withPlants(scene, world, [](const sim::Surface&) { return 1.0f; }),
                 {"density", "1 where a voxel is occupied", "1"}, world, fog);
  });
  const auto addSurface = [&](const auto& grid, auto valueOf, const About& about, auto finish) {
    using Value = decltype(valueOf(sim::Surface{}));
    using Tree = typename openvdb::tree::Tree4<Value, 5, 4, 3>::Type;
    add([&world, &grid, valueOf, about, finish] {
      auto result = shown(withPlants(std::make_shared<Tree>(grid->tree()), world, valueOf), about, world);
      finish(*result);
      return result;
    });
  };
  const auto nothing = [](openvdb::GridBase&) {};
  addSurface(
      grids.part, [](const sim::Surface& s) { return toVdb(s.part); },
      {"part", "number of the part that occupies a voxel, as listed in the file's metadata", "1"}, nothing);
  addSurface(
      grids.colour, [](const sim::Surface& s) { return toVdb(s.colour); },
      {"colour", "mean surface colour, linear RGB", "1"}, nothing);
  addSurface(
      grids.coverage, [](const sim::Surface& s) { return s.coverage; },
      {"coverage", "area inside a voxel over a face's area, 1 inside solids", "1"},
      [](openvdb::GridBase& grid) { grid.setGridClass(fog); });
  addSurface(
      grids.normal, [](const sim::Surface& s) { return toVdb(s.normal); },
      {"normal", "mean surface normal, zero where there is none", "1"},
      [](openvdb::GridBase& grid) { grid.setVectorType(openvdb::VEC_COVARIANT_NORMALIZE); });
  add([&] {
    return shown(std::make_shared<FloatTree>(grids.layer->tree()),
                 {"layer", "boundary layer: 0 on the scene, k voxels away from it in layer k", "1"}, world);
  });
  add([&] {
    return shown(std::make_shared<FloatTree>(grids.nearest->tree()),
                 {"nearest", "part of the nearest scene voxel", "1"}, world);
  });
  add([&] {
    return shown(grids.distance_vx->treePtr(),
                 {"distance", "distance to the nearest scene voxel, centre to centre", "voxel widths"},
                 world);
  });
  addFields(out, fields, world);
  Writer().writeAll(file, out, aboutFile(world, made_by));
}

void writeFieldVdb(std::ostream& file, const sim::World& world, const std::vector<VdbField>& fields,
                   const sim::Provenance& made_by) {
  openvdb::initialize();
  std::vector<MakeGrid> out;
  addFields(out, fields, world);
  Writer().writeAll(file, out, aboutFile(world, made_by));
}

std::string vdbBytes(const sim::World& world, const std::vector<VdbField>& fields,
                     const sim::Provenance& made_by) {
  return inMemory([&](std::ostream& out) { writeVdb(out, world, fields, made_by); });
}

std::string fieldVdbBytes(const sim::World& world, const std::vector<VdbField>& fields,
                          const sim::Provenance& made_by) {
  return inMemory([&](std::ostream& out) { writeFieldVdb(out, world, fields, made_by); });
}

}  // namespace espalier::render
