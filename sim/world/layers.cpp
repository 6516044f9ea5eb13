// Boundary layers: for the voxels near the scene, how many layers away it is, what is nearest and how far.
//
// Both the squared Euclidean and the Chebyshev distance part into one pass an axis (Felzenszwalb and
// Huttenlocher 2012, after Saito and Toriwaki 1994), here each over a window: a voxel within L layers has its
// nearest occupied voxel no farther than L sqrt(3). The nearest voxel's part travels in the low bits of the
// distance, so that the least key is the nearest part and among equally near ones the lowest.
//
// The world is cut into slabs of eight voxels along x, one leaf of the grids wide. Slabs are independent and
// are worked out in parallel; their leaves are put into the grids in the order of the slabs. Cost follows the
// rows that see a surface, times the window.
#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"
#include "sim/world/world_grids.h"

namespace espalier::sim {
namespace {

constexpr int kLanes = 8;
constexpr std::int16_t kNoLayer = std::numeric_limits<std::int16_t>::max();

using LayerLeaf = openvdb::Int32Tree::LeafNodeType;
using DistanceLeaf = openvdb::FloatTree::LeafNodeType;

struct Block {
  Voxel first;
  std::unique_ptr<LayerLeaf> layer;
  std::unique_ptr<LayerLeaf> nearest;
  std::unique_ptr<DistanceLeaf> distance_vx;
};

struct Reach {
  int layers;
  int window;     ///< how far along an axis the nearest voxel may be
  int part_bits;  ///< of a key
};

/// The last occupied x at or before `from` and not before `until`; until - 1 where there is none.
int lastAtOrBefore(const std::uint64_t* row, int from, int until) {
  while (from >= until) {
    const std::uint64_t word = row[from >> 6] << (63 - (from & 63));
    if (word != 0) return std::max(from - std::countl_zero(word), until - 1);
    from = (from & ~63) - 1;
  }
  return until - 1;
}

/// The first occupied x at or after `from` and before `until`; `until` where there is none.
int firstAtOrAfter(const std::uint64_t* row, int from, int until) {
  while (from < until) {
    const std::uint64_t word = row[from >> 6] >> (from & 63);
    if (word != 0) return std::min(from + std::countr_zero(word), until);
    from = (from | 63) + 1;
  }
  return until;
}

template <typename Key>
class Slab {
 public:
  Slab(const World& world, const BitVolume& scene, Reach reach, int first_x)
      : world_(world),
        scene_(scene),
        size_(scene.size()),
        reach_(reach),
        first_x_(first_x),
        rows_(static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(size_.z)),
        none_(static_cast<Key>(static_cast<Key>(3 * reach.window * reach.window + 1) << reach.part_bits)),
        along_x_(rows_),
        along_z_(rows_) {}

  std::vector<Block> blocks() {
    passX();
    passZ();
    std::vector<Block> found;
    for (int y = 0; y < size_.y; y += kLanes) {
      throwIfStopped();
      for (int z = 0; z < size_.z; z += kLanes) addBlock({first_x_, y, z}, found);
    }
    return found;
  }

 private:
  struct Row {
    std::array<Key, kLanes> key;
    std::array<std::int16_t, kLanes> layer;
  };
  /// Rows of eight voxels; those that see nothing are not even written.
  struct Rows {
    explicit Rows(std::size_t count) : seen(count), row(std::make_unique_for_overwrite<Row[]>(count)) {}
    std::vector<std::uint8_t> seen;
    std::unique_ptr<Row[]> row;
  };

  std::size_t index(int y, int z) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.z) + static_cast<std::size_t>(z);
  }
  Row emptyRow() const {
    Row row;
    row.key.fill(none_);
    row.layer.fill(kNoLayer);
    return row;
  }
  Key squared(int d) const { return static_cast<Key>(static_cast<Key>(d * d) << reach_.part_bits); }

  void passX() {
    const int until = std::min(first_x_ + kLanes + reach_.window, size_.x);
    for (int y = 0; y < size_.y; ++y) {
      throwIfStopped();
      for (int z = 0; z < size_.z; ++z) {
        const std::uint64_t* bits = scene_.row(y, z);
        if (firstAtOrAfter(bits, std::max(first_x_ - reach_.window, 0), until) == until) continue;
        along_x_.seen[index(y, z)] = 1;
        Row& row = along_x_.row[index(y, z)];
        row = emptyRow();
        // Of the voxels to the left and to the right of the eight only the nearest matter.
        const int before = lastAtOrBefore(bits, first_x_, std::max(first_x_ - reach_.window, 0));
        int x = scene_.at({before, y, z}) ? before : firstAtOrAfter(bits, first_x_ + 1, until);
        while (x < until) {
          spread(row, {x, y, z});
          if (x >= first_x_ + kLanes) break;
          x = firstAtOrAfter(bits, std::max(x, first_x_) + 1, until);
        }
      }
    }
  }

  /// One occupied voxel of the row seen from the eight.
  void spread(Row& row, Voxel from) const {
    const PartId guide = world_.guideAt(from);
    const Key part = static_cast<Key>(guide != kFree ? guide : world_.partAt(from));
    for (int lane = 0; lane < kLanes; ++lane) {
      const int d = std::abs(first_x_ + lane - from.x);
      if (d > reach_.window) continue;
      Key& key = row.key[static_cast<std::size_t>(lane)];
      key = std::min(key, static_cast<Key>(squared(d) | part));
      std::int16_t& layer = row.layer[static_cast<std::size_t>(lane)];
      if (d <= reach_.layers) layer = std::min(layer, static_cast<std::int16_t>(d));
    }
  }

  /// Lowers `to` by what `from` sees, d voxels away.
  void lower(Row& to, const Row& from, int d) const {
    const Key far = squared(d);
    for (std::size_t i = 0; i < kLanes; ++i)
      to.key[i] = std::min(to.key[i], static_cast<Key>(from.key[i] + far));
    if (std::abs(d) > reach_.layers) return;
    const auto layer = static_cast<std::int16_t>(std::abs(d));
    for (std::size_t i = 0; i < kLanes; ++i)
      to.layer[i] = std::min(to.layer[i], std::max(from.layer[i], layer));
  }

  void passZ() {
    for (int y = 0; y < size_.y; ++y) {
      throwIfStopped();
      for (int z = 0; z < size_.z; ++z) {
        if (along_x_.seen[index(y, z)] == 0) continue;
        const Row& from = along_x_.row[index(y, z)];
        const int last = std::min(z + reach_.window, size_.z - 1);
        for (int to = std::max(z - reach_.window, 0); to <= last; ++to) {
          const std::size_t i = index(y, to);
          if (along_z_.seen[i] == 0) {
            along_z_.seen[i] = 1;
            along_z_.row[i] = emptyRow();
          }
          lower(along_z_.row[i], from, to - z);
        }
      }
    }
  }

  /// The last pass, along y, for one row; false where no voxel of it lies within the layers.
  bool passY(int y, int z, Row& row) const {
    row = emptyRow();
    const int first = std::max(y - reach_.layers, 0);
    const int last = std::min(y + reach_.layers, size_.y - 1);
    for (int from = first; from <= last; ++from) {
      if (along_z_.seen[index(from, z)] != 0) lower(row, along_z_.row[index(from, z)], from - y);
    }
    if (*std::min_element(row.layer.begin(), row.layer.end()) == kNoLayer) return false;
    for (int from = std::max(y - reach_.window, 0); from < first; ++from) {
      if (along_z_.seen[index(from, z)] != 0) lower(row, along_z_.row[index(from, z)], from - y);
    }
    for (int from = last + 1; from <= std::min(y + reach_.window, size_.y - 1); ++from) {
      if (along_z_.seen[index(from, z)] != 0) lower(row, along_z_.row[index(from, z)], from - y);
    }
    return true;
  }

  void addBlock(Voxel first, std::vector<Block>& found) const {
    const Voxel end = glm::min(first + kLanes, size_);
    Block block{first, nullptr, nullptr, nullptr};
    Row row;
    for (int y = first.y; y < end.y; ++y) {
      for (int z = first.z; z < end.z; ++z) {
        if (!passY(y, z, row)) continue;
        if (block.layer == nullptr) {
          const openvdb::Coord at = coordOf(first);
          block.layer = std::make_unique<LayerLeaf>(at, -1);
          block.nearest = std::make_unique<LayerLeaf>(at, kFree);
          block.distance_vx = std::make_unique<DistanceLeaf>(at, std::numeric_limits<float>::infinity());
        }
        for (int x = first.x; x < end.x; ++x) write(block, {x, y, z}, row);
      }
    }
    if (block.layer != nullptr) found.push_back(std::move(block));
  }

  void write(Block& block, Voxel v, const Row& row) const {
    const auto lane = static_cast<std::size_t>(v.x - first_x_);
    if (row.layer[lane] == kNoLayer) return;
    const openvdb::Index n = LayerLeaf::coordToOffset(coordOf(v));
    const Key key = row.key[lane];
    block.layer->setValueOn(n, row.layer[lane]);
    block.nearest->setValueOn(n, static_cast<PartId>(key & ((Key{1} << reach_.part_bits) - 1)));
    block.distance_vx->setValueOn(n, std::sqrt(static_cast<float>(key >> reach_.part_bits)));
  }

  const World& world_;
  const BitVolume& scene_;
  Voxel size_;
  Reach reach_;
  int first_x_;
  std::size_t rows_;
  Key none_;
  Rows along_x_;
  Rows along_z_;
};

template <typename Key>
std::vector<std::vector<Block>> allSlabs(const World& world, const BitVolume& scene, Reach reach) {
  std::vector<std::vector<Block>> slabs(static_cast<std::size_t>((scene.size().x + kLanes - 1) / kLanes));
  parallelForEach(slabs.size(), [&](std::size_t i) {
    slabs[i] = Slab<Key>(world, scene, reach, static_cast<int>(i) * kLanes).blocks();
  });
  return slabs;
}

constexpr std::size_t kPadding = 2;  // steps: 32-bit loads of the last one

/// What has layers: the scene and its guides, and no plants, which do not stand between either. A plant's
/// voxel may be a guide's.
BitVolume felt(const World& world) {
  BitVolume scene = world.occupied();
  world.grids().plants.forEach([&](Voxel v, const Surface&) { scene.clear(v); });
  for (auto at = world.grids().guide->cbeginValueOn(); at; ++at)
    scene.set({at.getCoord().x(), at.getCoord().y(), at.getCoord().z()});
  return scene;
}

}  // namespace

World::Grids::Near::Near(Voxel size)
    : blocks(blocksOf(size)),
      block(static_cast<std::size_t>(blocks.x) * static_cast<std::size_t>(blocks.y) *
            static_cast<std::size_t>(blocks.z)),
      leaves(1) {
  findSteps(0);
}

void World::Grids::Near::add(Voxel v, const NearLeaves& block_leaves) {
  block[blockNumber(blocks, v)] = static_cast<std::uint32_t>(leaves.size()) * kInBlock;
  leaves.push_back(block_leaves);
}

void World::Grids::Near::findSteps(int layers) {
  steps.assign(leaves.size() * kInBlock + kPadding,
               static_cast<std::uint16_t>((layers + 1) * NearSteps::kInVoxel));
  parallelForEach(leaves.size() - 1, [&](std::size_t i) {
    const NearLeaves& known = leaves[i + 1];
    std::uint16_t* const of_block = steps.data() + (i + 1) * kInBlock;
    for (int n = 0; n < static_cast<int>(kInBlock); ++n) {
      const int x = n & 7, z = (n >> 3) & 7, y = n >> 6;
      const openvdb::Index at = LayerLeaf::coordToOffset({x, y, z});
      if (known.layer[at] < 0) continue;
      of_block[n] =
          static_cast<std::uint16_t>(std::lround(known.distance_vx[at] * float{NearSteps::kInVoxel}));
    }
  });
}

void World::setLayers(int layers) {
  constexpr int kMost = 128;  // distances of sqrt(3) layers in 1/256 voxel width stay within 16 bits
  if (layers < 0 || layers > kMost) {
    throw InputError(fmt::format("{} boundary layers: expected 0 to {}", layers, kMost));
  }
  if (layers == 0) {  // a voxel's own part is all there is to know (World::nearnessAt)
    clearLayers();
    return;
  }
  const int window = static_cast<int>(std::floor(std::sqrt(3.0) * layers));
  const Reach reach{layers, window, static_cast<int>(std::bit_width(parts_.size()))};
  const BitVolume scene = felt(*this);
  const bool short_keys =
      ((std::int64_t{5} * window * window + 1) << reach.part_bits) < (std::int64_t{1} << 31);
  auto slabs =
      short_keys ? allSlabs<std::int32_t>(*this, scene, reach) : allSlabs<std::int64_t>(*this, scene, reach);

  std::size_t blocks = 1;
  for (const std::vector<Block>& slab : slabs) blocks += slab.size();
  constexpr std::size_t kMostSteps = std::size_t{1} << 31;
  if (blocks * Grids::Near::kInBlock > kMostSteps) {
    throw InputError(fmt::format(
        "{} boundary layers take {} voxels, in blocks of 8 x 8 x 8; expected at most {}: fewer layers, or "
        "larger voxels",
        layers, (blocks - 1) * Grids::Near::kInBlock, kMostSteps));
  }
  clearLayers();
  grids_->near.leaves.reserve(blocks);
  for (std::vector<Block>& slab : slabs) {
    for (Block& block : slab) {
      grids_->near.add(block.first, {block.layer->buffer().data(), block.nearest->buffer().data(),
                                     block.distance_vx->buffer().data()});
      grids_->layer->tree().addLeaf(block.layer.release());
      grids_->nearest->tree().addLeaf(block.nearest.release());
      grids_->distance_vx->tree().addLeaf(block.distance_vx.release());
    }
  }
  grids_->near.findSteps(layers);
  layers_ = layers;
}

void World::clearLayers() {
  grids_->layer->clear();
  grids_->nearest->clear();
  grids_->distance_vx->clear();
  grids_->near = Grids::Near(frame_.size);
  layers_ = 0;
  ++version_;
}

}  // namespace espalier::sim
