#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/base/bits.h"
#include "sim/base/bricks.h"
#include "sim/base/frame.h"
#include "sim/base/vec.h"

namespace espalier::sim {

/// What a voxel belongs to. 0 is free space; parts are numbered from 1 in the order in which they were added.
using PartId = std::int32_t;
inline constexpr PartId kFree = 0;

enum class PartKind { scene, stem, element };

/// A named part of an object: a region of a scene mesh, a plant's stems, a plant's leaves.
struct Part {
  std::string object;  ///< the mesh's or the plant's name
  std::string region;  ///< the region's or the element's name
  PartKind kind = PartKind::scene;
  int plant = -1;  ///< the plant's number for stems and elements
  /// Of a scene object that nobody called solid: it is closed, at least in part, and was filled.
  bool found_closed = false;
};

/// What else could be done about something that lies inside of a part, to end a sentence with: to leave
/// hollow what was found to be closed; or nothing.
std::string orLeaveHollow(const Part& part);

/// What an occupied voxel knows.
struct Surface {
  PartId part = kFree;
  Colour colour{0.0f};  ///< linear RGB
  /// Area inside the voxel over a face's area. Of the scene at most 1, and 1 inside a solid; of plants the
  /// sum over all stems and elements in it, which may be more than 1.
  float coverage = 0.0f;
  Vec3f normal{
      0.0f};  ///< unit, area-weighted, as the triangles are wound; zero where there is none (lines, solids)
  float offset_vx = 0.0f;  ///< how far the surface lies from the voxel's centre along the normal
};

/// What a free or occupied voxel within the boundary layers knows of the nearest scene object.
struct Nearness {
  int layer = 0;  ///< 0 on the object itself, k in boundary layer k (26-adjacency, so Chebyshev distance)
  PartId part = kFree;  ///< the part of the nearest occupied voxel; among equally near ones the lowest number
  float distance_vx = 0.0f;  ///< between voxel centres, Euclidean
};

/// The distances to the scene for those who read many at once, in lanes: that of nearnessAt in whole steps of
/// 1/256 voxel width, rounded to nearest. Beyond the boundary layers layers() + 1 voxel widths, as
/// trials count it; without layers nothing is near, not even the scene itself. Valid until the
/// world ends or its layers are set anew.
struct NearSteps {
  static constexpr int kInVoxel = 256;  ///< steps in a voxel width

  Voxel blocks{0};  ///< of 8x8x8 voxels, along each axis
  /// Where in `steps` the 512 of a block begin; by blockNumber. All blocks that no layer touches share those
  /// at 0.
  const std::uint32_t* block = nullptr;
  /// Of a block by (y & 7) << 6 | (z & 7) << 3 | (x & 7). All places fit into 31 bits. Behind the last lie
  /// four bytes that may be read, for 32-bit loads.
  const std::uint16_t* steps = nullptr;

  /// The voxel must lie inside the world.
  std::uint16_t at(Voxel v) const;
};

/// The number of a voxel's block of 8x8x8 voxels: x fastest, then z, then y.
inline std::size_t blockNumber(Voxel blocks, Voxel v) {
  const auto along = [&](int axis) { return static_cast<std::size_t>(v[axis] >> 3); };
  return (along(1) * static_cast<std::size_t>(blocks.z) + along(2)) * static_cast<std::size_t>(blocks.x) +
         along(0);
}

inline std::uint16_t NearSteps::at(Voxel v) const {
  const auto in_block = static_cast<std::size_t>((v.y & 7) << 6 | (v.z & 7) << 3 | (v.x & 7));
  return steps[block[blockNumber(blocks, v)] + in_block];
}

struct TiledVoxel {
  Voxel voxel;
  Surface surface;
};

/// The voxel world. OpenVDB grids hold the truth (sim/world/world_grids.h opens them to those who need
/// OpenVDB); the packed occupancy is kept in step and is what rays and sweeps read. Const members may be
/// called from any number of threads.
class World {
 public:
  explicit World(const Frame& frame);
  World(const World&);
  World(World&&) noexcept;
  World& operator=(const World&);
  World& operator=(World&&) noexcept;
  ~World();

  const Frame& frame() const { return frame_; }
  /// Where anything is: the scene, stems, elements.
  const BitVolume& occupied() const { return occupied_; }
  /// Where something is that nothing grows through: the scene and stems. What is occupied but not solid holds
  /// elements alone.
  const BitVolume& solid() const { return solid_; }
  /// What takes light: of the scene what was said when it was added, and of the plants' voxels a share. A
  /// leaf takes up a whole voxel but stops few of the rays through it; so as many of the voxels stop all
  /// light as the leaves in them would stop rays. Which ones follows from their place, their part's kind and
  /// their coverage alone.
  const BitVolume& opaque() const { return opaque_; }
  /// The bricks in which anything takes light.
  const Bricks& opaqueBricks() const { return opaque_bricks_; }
  const std::vector<Part>& parts() const { return parts_; }
  const Part& part(PartId id) const { return parts_[static_cast<std::size_t>(id - 1)]; }
  int layers() const { return layers_; }
  /// Rises with every edit; quantities derived from an older version are stale.
  std::uint64_t version() const { return version_; }

  PartId addPart(Part part);
  /// Says it of all parts of a scene object.
  void setFoundClosed(const std::string& object);
  /// Occupies voxels. Scene voxels take all light. Throws BrokenContract for a voxel outside the world.
  /// One that is occupied already
  /// - by the scene, or now by the scene: keeps what it has;
  /// - by plants: adds the coverage of what comes, and takes light accordingly. A stem takes it over from
  ///   elements, with its part, colour and normal; else it keeps those that it had first.
  void occupy(std::span<const TiledVoxel> voxels);
  /// Occupies free voxels with a scene's; they take no light. One that is occupied already keeps what it has.
  void occupyClear(std::span<const TiledVoxel> voxels);
  /// Occupies blocks of 8x8x8 voxels, wholly free until now, with a scene's, given by their low corners
  /// (multiples of 8) with what all of their voxels are like. They take no room worth mentioning, and no
  /// light.
  void occupyBlocks(std::span<const TiledVoxel> blocks);
  /// Adds voxels to what takes light.
  void addOpaque(const BitVolume& voxels);
  /// Free voxels that are felt as the scene is, and hold nothing: of a guide's part and normal each. They
  /// count from the next setLayers on. Throws BrokenContract for a voxel outside the world; one that is
  /// occupied, or another guide's, keeps what it has.
  void addGuide(std::span<const TiledVoxel> voxels);
  /// Finds for every voxel within `layers` of a scene voxel, or of a guide, its Nearness; replaces what was
  /// known before. Throws InputError for more than 128 layers, and where they hold more voxels than NearSteps
  /// can count.
  void setLayers(int layers);

  /// kFree outside the world too.
  PartId partAt(Voxel v) const;
  /// The part whose guide a voxel is; kFree where none is.
  PartId guideAt(Voxel v) const;
  /// Unit, as the guide was modelled there; zero where none is, or it has no sides.
  Vec3f guideNormalAt(Voxel v) const;
  /// Of the voxels from `first` on along x that bits of `among` name (bit i: i voxels on), those that partAt
  /// says belong to a plant with this number. All of them must lie inside the world.
  std::uint64_t ofPlant(Voxel first, std::uint64_t among, int plant) const;
  /// Of the voxels that bits of `among` name, as above, those that belong to plants. All must lie inside the
  /// world.
  std::uint64_t ofPlants(Voxel first, std::uint64_t among) const;
  /// All of those.
  const BitVolume& inPlants() const;
  /// The same, of all plants but the one with this number.
  std::uint64_t ofOtherPlants(Voxel first, std::uint64_t among, int plant) const;
  std::optional<Surface> surfaceAt(Voxel v) const;
  std::optional<Nearness> nearnessAt(Voxel v) const;
  NearSteps nearSteps() const;
  /// All occupied voxels with their surfaces, in (y, z, x) order.
  std::vector<TiledVoxel> surfaces() const;

  struct Grids;
  const Grids& grids() const { return *grids_; }

 private:
  void keep(const TiledVoxel& tiled);
  void put(Voxel v, const Surface& surface);
  void join(const TiledVoxel& tiled);
  void shade(Voxel v, PartKind kind, float coverage);
  void findBlocks();
  void clearLayers();

  Frame frame_;
  BitVolume occupied_, solid_, opaque_;
  Bricks opaque_bricks_;
  std::vector<Part> parts_;
  int layers_ = 0;
  std::uint64_t version_ = 0;
  std::unique_ptr<Grids> grids_;
};

}  // namespace espalier::sim
