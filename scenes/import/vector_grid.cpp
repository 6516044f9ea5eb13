#include "scenes/import/vector_grid.h"

#include <fmt/format.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "scenes/clean_text.h"
#include "scenes/import/guarded_file.h"
#include "scenes/import/wire.h"
#include "scenes/problem.h"
#include "sim/base/error.h"
#include "sim/base/hasher.h"
#include "sim/base/parallel.h"

namespace espalier::scenes {
namespace {

constexpr double kFarthest = 1e6;  // metres, and numbers of vectors

bool inReach(sim::Vec3 v) {  // false of what is no number
  return std::abs(v.x) <= kFarthest && std::abs(v.y) <= kFarthest && std::abs(v.z) <= kFarthest;
}

sim::Vec3 vec3(const openvdb::Vec3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// Of a grid between its voxels; what is inactive is zero.
template <class Accessor>
sim::Vec3 linear(const Accessor& grid, sim::Vec3 at) {
  // A rounding of the transform is no place between voxels.
  constexpr double kRounding = 1e-6;
  const sim::Vec3 nearest = glm::round(at);
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(at[axis] - nearest[axis]) < kRounding) at[axis] = nearest[axis];
  }
  const sim::Vec3 low = glm::floor(at), part = at - low;
  sim::Vec3 sum(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    const sim::Vec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
    const sim::Vec3 weight = glm::mix(1.0 - part, part, step);
    const double share = weight.x * weight.y * weight.z;
    if (share == 0.0) continue;
    const sim::Vec3 voxel = low + step;
    typename Accessor::ValueType value;
    if (!grid.probeValue(
            openvdb::Coord(static_cast<int>(voxel.x), static_cast<int>(voxel.y), static_cast<int>(voxel.z)),
            value))
      continue;
    sum += share * vec3(openvdb::Vec3d(value));
  }
  return sum;
}

/// Points so far apart that there are not too many, along one axis and in all.
std::array<std::int32_t, 3> latticeOf(sim::Vec3 extent_m, double& apart_m, bool& coarser) {
  for (;;) {
    const sim::Vec3 size = glm::ceil(extent_m / apart_m - 1e-6) + 1.0;
    const double all = size.x * size.y * size.z, side = std::max({size.x, size.y, size.z});
    if (all <= static_cast<double>(kMostLatticePoints) && side <= kMostLatticeSide)
      return {static_cast<std::int32_t>(size.x), static_cast<std::int32_t>(size.y),
              static_cast<std::int32_t>(size.z)};
    coarser = true;
    apart_m *= std::max({1.01, 0.99 * std::cbrt(all / static_cast<double>(kMostLatticePoints)),
                         0.99 * side / kMostLatticeSide});
  }
}

/// The lattice's place: around the active voxels and one more.
VectorLattice placed(const openvdb::GridBase& grid) {
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) throw sim::InputError("it has no active voxels");
  const openvdb::math::Transform& transform = grid.transform();
  if (!transform.isLinear()) throw sim::InputError("its transform is not linear; expected a linear one");
  if (!grid.isInWorldSpace())
    throw sim::InputError("its vectors are in voxel space; expected them in world space");
  const openvdb::Vec3d first = box.min().asVec3d() - 1.0, last = box.max().asVec3d() + 1.0;
  sim::Vec3 low(INFINITY), high(-INFINITY);
  for (int corner = 0; corner < 8; ++corner) {
    openvdb::Vec3d at;
    for (int axis = 0; axis < 3; ++axis) at[axis] = (corner >> axis & 1) != 0 ? last[axis] : first[axis];
    const sim::Vec3 m = vec3(transform.indexToWorld(at));
    if (!inReach(m))
      throw sim::InputError(
          fmt::format("it reaches to [{:.3g}, {:.3g}, {:.3g}]; expected places from {:g} to {:g} metres", m.x,
                      m.y, m.z, -kFarthest, kFarthest));
    low = glm::min(low, m);
    high = glm::max(high, m);
  }
  VectorLattice lattice;
  lattice.low_m = low;
  const openvdb::Vec3d voxel = transform.voxelSize();
  lattice.apart_m = std::min({voxel.x(), voxel.y(), voxel.z()});
  if (!(lattice.apart_m > 0.0)) throw sim::InputError("its voxels have no width");
  lattice.size = latticeOf(high - low, lattice.apart_m, lattice.coarser);
  return lattice;
}

template <class Grid>
VectorLattice sampled(const Grid& grid) {
  const auto told = grid.template getMetadata<openvdb::Int64Metadata>(Grid::META_FILE_VOXEL_COUNT);
  if (told && told->value() != static_cast<std::int64_t>(grid.activeVoxelCount()))
    throw sim::InputError("the file is damaged or cut: a grid has not as many voxels as it says");
  VectorLattice lattice = placed(grid);
  const auto accessor = grid.getConstAccessor();
  const auto& [nx, ny, nz] = lattice.size;
  lattice.vectors.reserve(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) *
                          static_cast<std::size_t>(nz));
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        const sim::Vec3 m = lattice.low_m + lattice.apart_m * sim::Vec3(x, y, z);
        const sim::Vec3 vector =
            linear(accessor, vec3(grid.transform().worldToIndex(openvdb::Vec3d(m.x, m.y, m.z))));
        if (!inReach(vector))
          throw sim::InputError(fmt::format(
              "at [{:.4g}, {:.4g}, {:.4g}] it has the vector [{:.3g}, {:.3g}, {:.3g}]; expected numbers from "
              "{:g} to {:g}",
              m.x, m.y, m.z, vector.x, vector.y, vector.z, -kFarthest, kFarthest));
        lattice.vectors.push_back(vector);
      }
    }
  }
  return lattice;
}

bool holdsVectors(const openvdb::GridBase& grid) {
  return grid.isType<openvdb::Vec3SGrid>() || grid.isType<openvdb::Vec3DGrid>();
}

/// The grid that is meant.
openvdb::GridBase::Ptr chosen(const openvdb::GridPtrVec& grids, const std::string& name) {
  std::vector<std::string> names;
  openvdb::GridBase::Ptr first;
  for (const auto& grid : grids) {
    if (!name.empty() && grid->getName() == name) {
      if (holdsVectors(*grid)) return grid;
      throw sim::InputError(fmt::format("the grid {} holds {}; expected vectors, vec3s or vec3d",
                                        inQuotes(name), inQuotes(grid->valueType())));
    }
    if (!holdsVectors(*grid)) continue;
    names.push_back(grid->getName());
    if (!first) first = grid;
  }
  if (names.empty())
    throw sim::InputError("there is no grid of vectors in the file; expected a vec3s or vec3d");
  if (!name.empty())
    throw sim::InputError(fmt::format("there is no grid {} in the file; expected one of {}{}", inQuotes(name),
                                      listed(names, name), didYouMean(name, names)));
  if (names.size() > 1)
    throw sim::InputError(
        fmt::format("there are {} grids of vectors in the file: {}; expected grid: NAME, which of them",
                    names.size(), listed(names)));
  return first;
}

openvdb::GridPtrVecPtr gridsIn(const std::string& bytes) {
  try {
    std::istringstream stream(bytes, std::ios::binary);
    // Or what is cut off would read as nothing.
    stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    return openvdb::io::Stream(stream, false).getGrids();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw sim::InputError(
        fmt::format("the file is damaged or cut, or no OpenVDB file: {}", cleanText(error.what())));
  }
}

void require(bool sound) {
  if (!sound) throw std::runtime_error("a lattice that makes no sense");
}

}  // namespace

std::string packedLattice(const std::filesystem::path& file, const std::string& wanted) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw sim::InputError("cannot be read");
  VectorLattice lattice;
  // On one thread: of a forked child the parent's others do not live here.
  sim::onThreads(1, [&] {
    openvdb::initialize();
    const auto grids = gridsIn(bytes);
    const openvdb::GridBase::Ptr grid = chosen(*grids, wanted);
    try {
      const auto floats = openvdb::GridBase::grid<openvdb::Vec3SGrid>(grid);
      lattice = floats ? sampled(*floats) : sampled(*openvdb::GridBase::grid<openvdb::Vec3DGrid>(grid));
    } catch (const sim::InputError& error) {
      throw sim::InputError(fmt::format("the grid {}: {}", inQuotes(grid->getName()), error.what()));
    }
    lattice.name = grid->getName();
  });
  Packer out;
  out.put(sim::hashOf(bytes));
  out.putText(lattice.name);
  out.put(lattice.low_m);
  out.put(lattice.apart_m);
  out.put(lattice.size);
  out.putArray(lattice.vectors.data(), lattice.vectors.size());
  out.put(lattice.coarser);
  return out.take();
}

VectorLattice latticeFromChild(std::string_view bytes, sim::InputFile& read) {
  Unpacker in(bytes);
  VectorLattice lattice;
  read.hash = in.get<std::uint64_t>();
  lattice.name = in.getText();
  lattice.low_m = in.get<sim::Vec3>();
  lattice.apart_m = in.get<double>();
  lattice.size = in.get<std::array<std::int32_t, 3>>();
  lattice.vectors = in.getArray<sim::Vec3>();
  lattice.coarser = in.get<std::uint8_t>() != 0;
  in.requireEnd();
  require(inReach(lattice.low_m) && lattice.apart_m > 0.0 && lattice.apart_m <= kFarthest);
  std::int64_t all = 1;
  for (const std::int32_t side : lattice.size) {
    require(side > 0 && side <= kMostLatticeSide);
    all *= side;
  }
  require(all == static_cast<std::int64_t>(lattice.vectors.size()) && all <= kMostLatticePoints);
  require(std::all_of(lattice.vectors.begin(), lattice.vectors.end(), inReach));
  return lattice;
}

VectorLattice readVectorGrid(const std::filesystem::path& file, const std::string& grid,
                             sim::InputFile& read) {
  return namingFile(file, [&] {
    const ChildLimits limits = limitsFor(sizeOfFile(file, "volume"));
    read = {file.filename().string(), "volume", 0};
    return readInChild({"volume", {file.string(), grid}}, limits, "volume",
                       [&](std::string_view bytes) { return latticeFromChild(bytes, read); });
  });
}

}  // namespace espalier::scenes
