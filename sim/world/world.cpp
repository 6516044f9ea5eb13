#include "sim/world/world.h"

#include <fmt/format.h>

#include <cassert>
#include <limits>

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/world/world_grids.h"

namespace espalier::sim {
namespace {

template <typename Grid>
typename Grid::Ptr makeGrid(const char* name, const typename Grid::ValueType& background,
                            const openvdb::math::Transform::Ptr& transform) {
  auto grid = Grid::create(background);
  grid->setName(name);
  grid->setTransform(transform);
  return grid;
}

std::unique_ptr<World::Grids> makeGrids(const Frame& frame) {
  const auto transform = openvdb::math::Transform::createLinearTransform(frame.voxel_m);
  transform->postTranslate({frame.origin_m.x, frame.origin_m.y, frame.origin_m.z});
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const openvdb::Vec3f none(0.0f);
  return std::make_unique<World::Grids>(World::Grids{
      .part = makeGrid<openvdb::Int32Grid>("part", kFree, transform),
      .colour = makeGrid<openvdb::Vec3SGrid>("colour", none, transform),
      .coverage = makeGrid<openvdb::FloatGrid>("coverage", 0.0f, transform),
      .normal = makeGrid<openvdb::Vec3SGrid>("normal", none, transform),
      .offset_vx = makeGrid<openvdb::FloatGrid>("offset_vx", 0.0f, transform),
      .guide = makeGrid<openvdb::Int32Grid>("guide", kFree, transform),
      .guide_normal = makeGrid<openvdb::Vec3SGrid>("guide_normal", none, transform),
      .layer = makeGrid<openvdb::Int32Grid>("layer", -1, transform),
      .nearest = makeGrid<openvdb::Int32Grid>("nearest", kFree, transform),
      .distance_vx = makeGrid<openvdb::FloatGrid>("distance_vx", kFar, transform),
      .surface = BlockMap<World::Grids::SurfaceLeaves>(frame.size),
      .near = World::Grids::Near(frame.size),
      .plants = PlantVoxels(frame.size),
  });
}

openvdb::Index offsetInLeaf(Voxel v) {
  return openvdb::Int32Tree::LeafNodeType::coordToOffset(coordOf(v));
}

/// How large a share of the rays through a voxel its contents stop: their mean projected area over the
/// cube's, each a quarter of its surface (Cauchy 1850). A leaf of one-sided area A shows A / 2, a limb of
/// silhouette A about 0.8 A, and the cube 3 / 2 faces. Rises with the coverage, and when a stem takes over
/// from elements.
float opacity(PartKind kind, float coverage) {
  switch (kind) {
    case PartKind::scene:
      return 1.0f;  // a wall has no holes where a triangle only clips a voxel's corner
    case PartKind::stem:
      return std::min(coverage / 2.0f, 1.0f);
    case PartKind::element:
      return std::min(coverage / 3.0f, 1.0f);
  }
  return 1.0f;
}

bool stopsLight(Voxel v, float share) {
  static const std::uint64_t stream = streamOf(0);
  return Slots(keyAt(stream, v), Purpose::opacity).uniform(0) < static_cast<double>(share);
}

openvdb::Vec3f toVdb(glm::vec3 v) {
  return {v.x, v.y, v.z};
}
glm::vec3 fromVdb(const openvdb::Vec3f& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

World::World(const Frame& frame)
    : frame_(frame),
      occupied_(frame.size),
      solid_(frame.size),
      opaque_(frame.size),
      opaque_bricks_(frame.size),
      grids_(makeGrids(frame)) {}
World::World(const World& other)
    : frame_(other.frame_),
      occupied_(other.occupied_),
      solid_(other.solid_),
      opaque_(other.opaque_),
      opaque_bricks_(other.opaque_bricks_),
      parts_(other.parts_),
      layers_(other.layers_),
      version_(other.version_),
      grids_(std::make_unique<Grids>(Grids{
          .part = other.grids_->part->deepCopy(),
          .colour = other.grids_->colour->deepCopy(),
          .coverage = other.grids_->coverage->deepCopy(),
          .normal = other.grids_->normal->deepCopy(),
          .offset_vx = other.grids_->offset_vx->deepCopy(),
          .guide = other.grids_->guide->deepCopy(),
          .guide_normal = other.grids_->guide_normal->deepCopy(),
          .layer = other.grids_->layer->deepCopy(),
          .nearest = other.grids_->nearest->deepCopy(),
          .distance_vx = other.grids_->distance_vx->deepCopy(),
          .surface = BlockMap<Grids::SurfaceLeaves>(frame_.size),
          .near = other.grids_->near,
          .plants = other.grids_->plants,
      })) {
  findBlocks();
}
World& World::operator=(const World& other) {
  return *this = World(other);
}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

PartId World::addPart(Part part) {
  parts_.push_back(std::move(part));
  return static_cast<PartId>(parts_.size());
}

void World::setFoundClosed(const std::string& object) {
  for (Part& part : parts_) {
    if (part.object == object && part.kind == PartKind::scene) part.found_closed = true;
  }
}

std::string orLeaveHollow(const Part& part) {
  if (!part.found_closed) return "";
  return fmt::format(", or leave '{}' hollow with solid: false: it is closed, and was filled", part.object);
}

void World::keep(const TiledVoxel& tiled) {
  const auto& [voxel, surface] = tiled;
  if (!contains(frame_.size, voxel)) {
    throw BrokenContract(
        fmt::format("voxel ({}, {}, {}) lies outside the world of {} x {} x {} and cannot be occupied",
                    voxel.x, voxel.y, voxel.z, frame_.size.x, frame_.size.y, frame_.size.z));
  }
  assert(surface.part > kFree && static_cast<std::size_t>(surface.part) <= parts_.size());
  occupied_.set(voxel);
  const PartKind kind = part(surface.part).kind;
  if (kind != PartKind::element) solid_.set(voxel);
  if (kind == PartKind::scene)
    put(voxel, surface);
  else
    grids_->plants.add(voxel, surface, part(surface.part).plant);
}

void World::put(Voxel voxel, const Surface& surface) {
  Grids::SurfaceLeaves& leaves = grids_->surface.make(voxel);
  if (leaves.part == nullptr) {
    const openvdb::Coord at = coordOf(voxel);
    leaves = {grids_->part->tree().touchLeaf(at), grids_->colour->tree().touchLeaf(at),
              grids_->coverage->tree().touchLeaf(at), grids_->normal->tree().touchLeaf(at),
              grids_->offset_vx->tree().touchLeaf(at)};
  }
  const openvdb::Index n = offsetInLeaf(voxel);
  leaves.part->setValueOn(n, surface.part);
  leaves.colour->setValueOn(n, toVdb(surface.colour));
  leaves.coverage->setValueOn(n, surface.coverage);
  leaves.normal->setValueOn(n, toVdb(surface.normal));
  leaves.offset_vx->setValueOn(n, surface.offset_vx);
}

/// More comes into a voxel that is occupied.
void World::join(const TiledVoxel& tiled) {
  const auto& [voxel, surface] = tiled;
  PlantVoxels& plants = grids_->plants;
  const PartKind kind = part(surface.part).kind;
  if (kind == PartKind::scene || plants.partAt(voxel) == kFree) return;
  const float coverage = plants.addCoverage(voxel, surface.coverage);
  if (kind == PartKind::stem && !solid_.at(voxel)) {
    plants.takeOver(voxel, surface, part(surface.part).plant);
    solid_.set(voxel);
  }
  shade(voxel, part(plants.partAt(voxel)).kind, coverage);
}

void World::shade(Voxel v, PartKind kind, float coverage) {
  if (!stopsLight(v, opacity(kind, coverage))) return;
  opaque_.set(v);
  opaque_bricks_.add(v);
}

/// The grids' leaves by block, where the grids were not made leaf by leaf here.
void World::findBlocks() {
  for (auto leaf = grids_->part->tree().beginLeaf(); leaf; ++leaf) {
    const openvdb::Coord at = leaf->origin();
    grids_->surface.make({at.x(), at.y(), at.z()}) = {
        leaf.getLeaf(), grids_->colour->tree().probeLeaf(at), grids_->coverage->tree().probeLeaf(at),
        grids_->normal->tree().probeLeaf(at), grids_->offset_vx->tree().probeLeaf(at)};
  }
  for (auto leaf = grids_->layer->tree().cbeginLeaf(); leaf; ++leaf) {
    const openvdb::Coord at = leaf->origin();
    Grids::Near& near = grids_->near;  // its leaves are still the other world's
    near.leaves[near.block[blockNumber(near.blocks, {at.x(), at.y(), at.z()})] / Grids::Near::kInBlock] = {
        leaf->buffer().data(), grids_->nearest->tree().probeConstLeaf(at)->buffer().data(),
        grids_->distance_vx->tree().probeConstLeaf(at)->buffer().data()};
  }
}

void World::occupy(std::span<const TiledVoxel> voxels) {
  constexpr std::size_t kAhead = 12;  // scattered voxels are waited for in memory
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if (i + kAhead < voxels.size() && contains(frame_.size, voxels[i + kAhead].voxel)) {
      const Voxel later = voxels[i + kAhead].voxel;
      for (const BitVolume* const bits : {&occupied_, &solid_, &opaque_})
        __builtin_prefetch(bits->row(later.y, later.z) + (later.x >> 6));
      grids_->plants.prefetch(later);
    }
    const TiledVoxel& tiled = voxels[i];
    if (occupied_.at(tiled.voxel)) {
      join(tiled);
      continue;
    }
    keep(tiled);
    shade(tiled.voxel, part(tiled.surface.part).kind, tiled.surface.coverage);
  }
  ++version_;
}

void World::occupyClear(std::span<const TiledVoxel> voxels) {
  for (const TiledVoxel& tiled : voxels) {
    if (!occupied_.at(tiled.voxel)) keep(tiled);
  }
  ++version_;
}

void World::occupyBlocks(std::span<const TiledVoxel> blocks) {
  const auto fill = [](auto& tree, Voxel corner, const auto& value) {
    tree.addTile(1, coordOf(corner), value, true);  // level 1: as large as a leaf
  };
  for (const auto& [corner, surface] : blocks) {
    for (int y = 0; y < 8; ++y) {
      for (int z = 0; z < 8; ++z) {
        assert((occupied_.row(corner.y + y, corner.z + z)[corner.x >> 6] >> (corner.x & 63) & 0xffu) == 0);
        for (BitVolume* const bits : {&occupied_, &solid_})
          bits->row(corner.y + y, corner.z + z)[corner.x >> 6] |= std::uint64_t{0xff} << (corner.x & 63);
      }
    }
    fill(grids_->part->tree(), corner, surface.part);
    fill(grids_->colour->tree(), corner, toVdb(surface.colour));
    fill(grids_->coverage->tree(), corner, surface.coverage);
    fill(grids_->normal->tree(), corner, toVdb(surface.normal));
    fill(grids_->offset_vx->tree(), corner, surface.offset_vx);
  }
  ++version_;
}

void World::addOpaque(const BitVolume& voxels) {
  assert(voxels.size() == frame_.size);
  opaque_.add(voxels);
  opaque_bricks_.add(Bricks(voxels));
  ++version_;
}

void World::addGuide(std::span<const TiledVoxel> voxels) {
  for (const auto& [v, surface] : voxels) {
    if (!contains(frame_.size, v)) throw BrokenContract("a guide's voxel lies outside the world");
    if (occupied_.at(v) || guideAt(v) != kFree) continue;
    grids_->guide->tree().setValueOn(coordOf(v), surface.part);
    grids_->guide_normal->tree().setValueOn(coordOf(v), toVdb(surface.normal));
  }
  ++version_;
}

Vec3f World::guideNormalAt(Voxel v) const {
  return fromVdb(grids_->guide_normal->tree().getValue(coordOf(v)));
}

PartId World::guideAt(Voxel v) const {
  return grids_->guide->tree().getValue(coordOf(v));
}

PartId World::partAt(Voxel v) const {
  if (!occupied_.at(v)) return kFree;
  if (const PartId plant = grids_->plants.partAt(v); plant != kFree) return plant;
  const Grids::SurfaceLeaves& leaves = grids_->surface.of(v);
  return leaves.part != nullptr ? leaves.part->getValue(offsetInLeaf(v))
                                : grids_->part->tree().getValue(coordOf(v));
}

std::uint64_t World::ofPlant(Voxel first, std::uint64_t among, int plant) const {
  return grids_->plants.ofPlant(first, among, plant, [&](PartId id) { return part(id).plant; });
}

std::uint64_t World::ofOtherPlants(Voxel first, std::uint64_t among, int plant) const {
  return ofPlants(first, among) & ~ofPlant(first, among, plant);
}

std::uint64_t World::ofPlants(Voxel first, std::uint64_t among) const {
  return grids_->plants.takenAmong(first, among);
}

const BitVolume& World::inPlants() const {
  return grids_->plants.taken();
}

std::optional<Surface> World::surfaceAt(Voxel v) const {
  if (!occupied_.at(v)) return std::nullopt;
  if (const auto plant = grids_->plants.surfaceAt(v)) return plant;
  const Grids::SurfaceLeaves& leaves = grids_->surface.of(v);
  if (leaves.part == nullptr) {  // in a block whose voxels are alike
    const openvdb::Coord at = coordOf(v);
    return Surface{grids_->part->tree().getValue(at), fromVdb(grids_->colour->tree().getValue(at)),
                   grids_->coverage->tree().getValue(at), fromVdb(grids_->normal->tree().getValue(at)),
                   grids_->offset_vx->tree().getValue(at)};
  }
  const openvdb::Index n = offsetInLeaf(v);
  return Surface{leaves.part->getValue(n), fromVdb(leaves.colour->getValue(n)), leaves.coverage->getValue(n),
                 fromVdb(leaves.normal->getValue(n)), leaves.offset_vx->getValue(n)};
}

std::optional<Nearness> World::nearnessAt(Voxel v) const {
  if (!contains(frame_.size, v)) return std::nullopt;
  if (layers_ == 0) {
    const PartId own = partAt(v);
    if (own == kFree || part(own).kind != PartKind::scene) return std::nullopt;
    return Nearness{0, own, 0.0f};
  }
  const Grids::NearLeaves& leaves = grids_->near.of(v);
  if (leaves.layer == nullptr) return std::nullopt;
  const openvdb::Index n = offsetInLeaf(v);
  if (leaves.layer[n] < 0) return std::nullopt;
  return Nearness{leaves.layer[n], leaves.nearest[n], leaves.distance_vx[n]};
}

NearSteps World::nearSteps() const {
  const Grids::Near& near = grids_->near;
  return {near.blocks, near.block.data(), near.steps.data()};
}

std::vector<TiledVoxel> World::surfaces() const {
  std::vector<TiledVoxel> all;
  all.reserve(occupied_.count());
  for (int y = 0; y < frame_.size.y; ++y) {
    for (int z = 0; z < frame_.size.z; ++z) {
      const std::uint64_t* row = occupied_.row(y, z);
      for (int w = 0; w < occupied_.rowWords(); ++w) {
        for (std::uint64_t word = row[w]; word != 0; word &= word - 1) {
          const Voxel v(w * BitVolume::kWordBits + std::countr_zero(word), y, z);
          all.push_back({v, *surfaceAt(v)});
        }
      }
    }
  }
  return all;
}

}  // namespace espalier::sim
