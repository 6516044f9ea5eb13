#include "render/vdb.h"

#include <fmt/format.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tree/LeafManager.h>
#include <xxhash.h>

#include <sstream>

#include "sim/error.h"
#include "sim/sense/exposure.h"
#include "sim/world_grids.h"

namespace espalier::render {
namespace {

// Magic number (8), file version (4), library version (4 + 4), flag for grid offsets (1), then the id as
// text.
constexpr std::size_t kIdAt = 21, kIdLength = 36;

struct About {
  const char* name;
  const char* description;
  const char* unit;
};

/// Shares the grid's tree but not its metadata.
template <class Grid>
typename Grid::Ptr shown(const typename Grid::Ptr& grid, const About& about, const sim::Frame& frame,
                         openvdb::GridClass grid_class = openvdb::GRID_UNKNOWN) {
  auto result = Grid::create(grid->treePtr());
  result->setTransform(grid->transform().copy());
  result->setName(about.name);
  result->setGridClass(grid_class);
  result->setCreator("Espalier");
  result->insertMeta("description", openvdb::StringMetadata(about.description));
  result->insertMeta("unit", openvdb::StringMetadata(about.unit));
  result->insertMeta("voxel_m", openvdb::DoubleMetadata(frame.voxel_m));
  return result;
}

openvdb::FloatGrid::Ptr density(const sim::World::Grids& grids) {
  auto tree = std::make_shared<openvdb::FloatTree>(grids.part->tree(), 0.0f, 1.0f, openvdb::TopologyCopy());
  auto grid = openvdb::FloatGrid::create(tree);
  grid->setTransform(grids.part->transform().copy());
  return grid;
}

openvdb::FloatGrid::Ptr exposure(const sim::World& world, const sim::ExposureField& field) {
  if (field.size != world.frame().size)
    throw sim::InputError("an exposure field has another size than the world");
  const sim::World::Grids& grids = world.grids();
  auto tree = std::make_shared<openvdb::FloatTree>(grids.part->tree(), 0.0f, openvdb::TopologyCopy());
  tree->topologyUnion(grids.layer->tree());
  tree->voxelizeActiveTiles();
  openvdb::tree::LeafManager<openvdb::FloatTree>(*tree).foreach ([&](auto& leaf, std::size_t) {
    for (auto value = leaf.beginValueOn(); value; ++value) {
      const openvdb::Coord at = value.getCoord();
      const sim::Voxel v(at.x(), at.y(), at.z());
      const auto surface = world.surfaceAt(v);
      value.setValue(surface ? sim::surfaceExposure(world.occupied(), field, v, surface->normal)
                             : field.at(v));
    }
  });
  auto grid = openvdb::FloatGrid::create(tree);
  grid->setTransform(grids.part->transform().copy());
  return grid;
}

openvdb::MetaMap aboutFile(const sim::World& world) {
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
  return file;
}

/// An id in the shape that OpenVDB expects (a version 8 UUID: its own scheme), from the bytes around it.
void setId(std::string& bytes) {
  bytes.replace(kIdAt, kIdLength, kIdLength, '0');
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  std::string hex = fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
  hex[12] = '8';
  hex[16] = '8';
  for (const std::size_t at : {8u, 13u, 18u, 23u}) hex.insert(at, 1, '-');
  bytes.replace(kIdAt, kIdLength, hex);
}

}  // namespace

std::string vdbBytes(const sim::World& world, const ExposureFields& fields) {
  openvdb::initialize();
  using openvdb::FloatGrid, openvdb::Int32Grid, openvdb::Vec3SGrid;
  const sim::World::Grids& grids = world.grids();
  const sim::Frame& frame = world.frame();
  const auto fog = openvdb::GRID_FOG_VOLUME;

  openvdb::GridPtrVec out;
  out.push_back(
      shown<FloatGrid>(density(grids), {"density", "1 where a voxel is occupied", "1"}, frame, fog));
  out.push_back(shown<Int32Grid>(
      grids.part, {"part", "number of the part that occupies a voxel, as listed in the file's metadata", "1"},
      frame));
  out.push_back(shown<Vec3SGrid>(grids.colour, {"colour", "mean surface colour, linear RGB", "1"}, frame));
  out.push_back(shown<FloatGrid>(
      grids.coverage, {"coverage", "occupied fraction of a voxel, 1 inside solids", "1"}, frame, fog));
  auto normal =
      shown<Vec3SGrid>(grids.normal, {"normal", "mean surface normal, zero where there is none", "1"}, frame);
  normal->setVectorType(openvdb::VEC_COVARIANT_NORMALIZE);
  out.push_back(normal);
  out.push_back(shown<Int32Grid>(
      grids.layer, {"layer", "boundary layer: 0 on the scene, k voxels away from it in layer k", "1"},
      frame));
  out.push_back(shown<Int32Grid>(grids.nearest, {"nearest", "part of the nearest scene voxel", "1"}, frame));
  out.push_back(shown<FloatGrid>(
      grids.distance_vx,
      {"distance", "distance to the nearest scene voxel, centre to centre", "voxel widths"}, frame));
  if (fields.sun) {
    out.push_back(shown<FloatGrid>(exposure(world, *fields.sun),
                                   {"sun_exposure", "fraction of the sun's arc in sight", "1"}, frame));
  }
  if (fields.sky) {
    out.push_back(shown<FloatGrid>(exposure(world, *fields.sky),
                                   {"sky_exposure", "fraction of the sky in sight", "1"}, frame));
  }

  std::ostringstream stream(std::ios::binary);
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  openvdb::io::Stream(stream).write(out, aboutFile(world));
  std::string bytes = std::move(stream).str();
  setId(bytes);
  return bytes;
}

}  // namespace espalier::render
