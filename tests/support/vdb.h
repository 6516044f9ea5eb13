#pragma once
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <map>
#include <sstream>
#include <string>

namespace espalier::tests {

/// A .vdb file as another program would read it.
struct ReadBack {
  openvdb::MetaMap::Ptr about;
  std::map<std::string, openvdb::GridBase::Ptr> grids;

  template <class Grid>
  typename Grid::Ptr grid(const std::string& name) const {
    const auto found = grids.find(name);
    return found == grids.end() ? nullptr : openvdb::gridPtrCast<Grid>(found->second);
  }
};

inline ReadBack readBack(const std::string& bytes) {
  openvdb::initialize();
  std::istringstream in(bytes, std::ios::binary);
  openvdb::io::Stream stream(in, false);
  ReadBack result{stream.getMetadata(), {}};
  for (const auto& grid : *stream.getGrids()) result.grids[grid->getName()] = grid;
  return result;
}

}  // namespace espalier::tests
