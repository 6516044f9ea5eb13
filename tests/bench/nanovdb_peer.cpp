// The one unit that converts to NanoVDB: it takes long to compile.
// NanoVDB leaves the steps along axes that a ray does not take unset and unread.
#ifndef __clang__  // which calls itself GCC and has no such warning
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <fmt/format.h>
#include <nanovdb/util/HDDA.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <nanovdb/util/Ray.h>
#include <openvdb/openvdb.h>

#include "sim/base/parallel.h"
#include "tests/bench/peers.h"

namespace espalier::bench {
namespace {

using Grid = nanovdb::NanoGrid<nanovdb::ValueMask>;
using Handle = nanovdb::GridHandle<>;
using Ray = nanovdb::Ray<float>;
using Accessor = Grid::AccessorType;

std::shared_ptr<const Handle> gridOf(const sim::BitVolume& occupied) {
  openvdb::initialize();
  auto mask = openvdb::MaskGrid::create();
  auto accessor = mask->getAccessor();
  const sim::Voxel size = occupied.size();
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        if (occupied.at({x, y, z})) accessor.setValueOn({x, y, z});
      }
    }
  }
  mask->pruneGrid();  // solid blocks become tiles
  return std::make_shared<const Handle>(nanovdb::openToNanoVDB(*mask));
}

/// As the library offers it. It looks more than a voxel ahead of where it stands, so it misses voxels that a
/// ray only clips.
struct FirstActive {
  static constexpr const char* kName = "NanoVDB, its firstActive";
  static bool reachesEdge(Ray ray, Accessor& accessor) {
    nanovdb::Coord ijk;
    float t = 0.0f;
    return !nanovdb::firstActive(ray, accessor, ijk, t);
  }
};

/// The same HDDA, asked at every voxel on the way.
struct EveryVoxel {
  static constexpr const char* kName = "NanoVDB, its HDDA at every voxel";
  static bool reachesEdge(Ray ray, Accessor& accessor) {
    if (!ray.clip(accessor.root().bbox())) return true;
    nanovdb::Coord ijk = nanovdb::RoundDown<nanovdb::Coord>(ray.start());
    nanovdb::HDDA<Ray> hdda(ray, static_cast<int>(accessor.getDim(ijk, ray)));
    for (;;) {
      if (accessor.isActive(ijk)) return false;
      if (!hdda.step()) return true;
      ijk = hdda.dim() == 1 ? hdda.voxel() : nanovdb::RoundDown<nanovdb::Coord>(ray(hdda.time() + 1e-4f));
      hdda.update(ray, static_cast<int>(accessor.getDim(ijk, ray)));
    }
  }
};

template <class Walk>
class NanovdbPeer : public Peer {
 public:
  explicit NanovdbPeer(std::shared_ptr<const Handle> handle) : handle_(std::move(handle)) {}
  std::string name() const override { return Walk::kName; }
  Sums answer(const Question& question) const override {
    std::vector<Ray::Vec3T> units;
    for (const auto& direction : question.directions) {
      const sim::Vec3f unit(glm::normalize(sim::Vec3(direction.v)));
      units.emplace_back(unit.x, unit.y, unit.z);
    }
    const Grid& grid = *handle_->grid<nanovdb::ValueMask>();
    Sums sums(question.places.size());
    sim::parallelFor(sums.size(), 256, [&](std::size_t begin, std::size_t end) {
      Accessor accessor = grid.getAccessor();
      for (std::size_t i = begin; i < end; ++i) {
        const sim::Vec3f middle = sim::Vec3f(question.places[i]) + 0.5f;
        unsigned sum = 0;
        for (std::size_t d = 0; d < units.size(); ++d) {
          if (Walk::reachesEdge(Ray({middle.x, middle.y, middle.z}, units[d]), accessor))
            sum += question.directions[d].weight;
        }
        sums[i] = static_cast<std::uint16_t>(sum);
      }
    });
    return sums;
  }

 private:
  std::shared_ptr<const Handle> handle_;
};

}  // namespace

Peers nanovdbPeers(const sim::BitVolume& occupied) {
  const auto handle = gridOf(occupied);
  Peers peers;
  peers.push_back(std::make_unique<NanovdbPeer<FirstActive>>(handle));
  peers.push_back(std::make_unique<NanovdbPeer<EveryVoxel>>(handle));
  return peers;
}

std::string vdbVersions() {
  return fmt::format("OpenVDB {}, NanoVDB {}.{}.{}", openvdb::getLibraryVersionString(),
                     NANOVDB_MAJOR_VERSION_NUMBER, NANOVDB_MINOR_VERSION_NUMBER,
                     NANOVDB_PATCH_VERSION_NUMBER);
}

}  // namespace espalier::bench
