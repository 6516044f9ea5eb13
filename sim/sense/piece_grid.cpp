#include "sim/sense/piece_grid.h"

#include <algorithm>

#include "sim/base/error.h"
#include "sim/tile/tiling.h"

namespace espalier::sim {
namespace {

constexpr int kCell = 4;  // voxels
constexpr int kHalfVoxel = static_cast<int>(kFixedOne / 2);
constexpr int kCellPoints = kCell * static_cast<int>(kFixedOne);
constexpr int kFewCells = 8;  // a piece whose bounds touch more is listed part by part
constexpr std::uint32_t kByParts = 1u << 31;
constexpr std::size_t kPool = std::size_t{1} << 15;

std::size_t indexIn(Voxel size, Voxel v) {
  return (static_cast<std::size_t>(v.y) * static_cast<std::size_t>(size.z) + static_cast<std::size_t>(v.z)) *
             static_cast<std::size_t>(size.x) +
         static_cast<std::size_t>(v.x);
}

std::size_t inBlock(Voxel cell) {
  return static_cast<std::size_t>((cell.x & 1) | ((cell.z & 1) << 1) | ((cell.y & 1) << 2));
}

template <typename Visit>
void forEachCell(Voxel low, Voxel high, Visit visit) {
  for (int y = low.y; y <= high.y; ++y) {
    for (int z = low.z; z <= high.z; ++z) {
      for (int x = low.x; x <= high.x; ++x) visit(Voxel(x, y, z));
    }
  }
}

/// The middle, rounded down; sums stay within 32 bits.
LatticePoint between(LatticePoint a, LatticePoint b) {
  return (a >> 1) + (b >> 1) + (a & b & 1);
}

/// Halving rounds: what a part of a piece covers lies within this of its corners.
LatticeBox rounded(LatticeBox box) {
  constexpr int kSlack = 16;  // at most 1 for each halving of 2^14 voxels
  return {box.low - kSlack, box.high + kSlack};
}

bool wide(const LatticeBox& box) {
  const LatticePoint span = box.high - box.low;
  return std::max({span.x, span.y, span.z}) > 0xffff;
}

}  // namespace

FacetShape facetShape(const std::vector<std::vector<Vec3>>& polygons) {
  FacetShape shape;
  const auto numberOf = [&](Vec3 corner) {
    const auto at = std::find(shape.corners.begin(), shape.corners.end(), corner);
    const auto number = static_cast<std::uint32_t>(at - shape.corners.begin());
    if (at == shape.corners.end()) shape.corners.push_back(corner);
    return number;
  };
  for (const auto& polygon : polygons) {
    for (std::size_t i = 2; i < polygon.size(); ++i)
      shape.triangles.push_back({numberOf(polygon[0]), numberOf(polygon[i - 1]), numberOf(polygon[i])});
  }
  return shape;
}

PieceGrid::PieceGrid(Voxel size)
    : cells_((size + (kCell - 1)) / kCell),
      blocks_((cells_ + 1) / 2),
      block_of_(static_cast<std::size_t>(blocks_.x) * static_cast<std::size_t>(blocks_.y) *
                static_cast<std::size_t>(blocks_.z)) {}

void PieceGrid::addPart(PartId part, int plant, std::shared_ptr<const FacetShape> shape) {
  const auto number = static_cast<std::size_t>(part);
  if (number >= kinds_.size()) kinds_.resize(number + 1);
  kinds_[number] = {plant, std::move(shape)};
}

const FacetShape& PieceGrid::shapeOf(PartId part) const {
  const auto number = static_cast<std::size_t>(part);
  if (part < 0 || number >= kinds_.size() || !kinds_[number].shape)
    throw BrokenContract("a part has no elements");
  return *kinds_[number].shape;
}

int PieceGrid::CellBox::count() const {
  const Voxel span = high - low + 1;
  const std::int64_t count = std::int64_t{span.x} * span.y * span.z;
  return static_cast<int>(std::min<std::int64_t>(count, 1 << 30));
}

Voxel PieceGrid::cellAt(LatticePoint p) const {
  static_assert(kCellPoints == 1 << 14);
  // Voxels' centres lie at whole numbers. Shifting rounds down.
  return glm::clamp(Voxel((p + kHalfVoxel) >> 14), Voxel(0), cells_ - 1);
}

PieceGrid::CellBox PieceGrid::cellsOf(const LatticeBox& box) const {
  return {cellAt(box.low), cellAt(box.high)};
}

void PieceGrid::list(std::uint32_t number, const LatticeBox& box) {
  const CellBox cells = cellsOf(box);
  forEachCell(cells.low, cells.high, [&](Voxel cell) {
    std::uint32_t& block = block_of_[indexIn(blocks_, cell / 2)];
    if (block == 0) {
      block = static_cast<std::uint32_t>(contents_.size());
      contents_.emplace_back();
    }
    std::uint32_t& first = contents_[block][inBlock(cell)];
    if (first == 0 || chunks_[first].pieces.back() != 0) {
      if (first != 0 && chunks_[first].pieces.back() == number) return;
      const std::uint32_t older = first;
      first = static_cast<std::uint32_t>(chunks_.size());
      chunks_.emplace_back();
      chunks_[first].older = older;
    }
    auto& pieces = chunks_[first].pieces;
    const auto room = std::find(pieces.begin(), pieces.end(), 0u);
    if (room != pieces.begin() && *(room - 1) == number) return;  // another part of it
    *room = number;
  });
}

void PieceGrid::listLimb(std::uint32_t number, LatticePoint from, LatticePoint to) {
  const LatticeBox box = boxOf(from, to);
  if (cellsOf(box).count() <= kFewCells) return list(number, rounded(box));
  const LatticePoint middle = between(from, to);
  listLimb(number, from, middle);
  listLimb(number, middle, to);
}

void PieceGrid::listTriangle(std::uint32_t number, const LatticeTriangle& t) {
  const LatticeBox box = boxOf(t);
  if (cellsOf(box).count() <= kFewCells) return list(number, rounded(box));
  const LatticePoint ab = between(t[0], t[1]), bc = between(t[1], t[2]), ca = between(t[2], t[0]);
  for (const LatticeTriangle& part :
       {LatticeTriangle{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}})
    listTriangle(number, part);
}

std::uint32_t PieceGrid::keep(const Facets& element) {
  const bool is_wide = wide(element.box);
  const std::size_t room = element.corners.size() * (is_wide ? 6 : 3);
  if (corners_.empty() || corners_.back().capacity() - corners_.back().size() < room) {
    corners_.emplace_back();
    corners_.back().reserve(std::max(room, kPool));
  }
  auto& pool = corners_.back();
  const auto at = static_cast<std::uint32_t>((corners_.size() - 1) * kPool + pool.size());
  for (const LatticePoint corner : element.corners) {
    const glm::uvec3 step(corner - element.box.low);
    for (int axis = 0; axis < 3; ++axis) {
      pool.push_back(static_cast<std::uint16_t>(step[axis] & 0xffffu));
      if (is_wide) pool.push_back(static_cast<std::uint16_t>(step[axis] >> 16));
    }
  }
  return at;
}

void PieceGrid::add(const Limb& limb) {
  pieces_.emplace_back() = {limb.from, limb.to, static_cast<std::uint32_t>(limb.node), -limb.stem};
  const LatticeBox box = boxOf(limb.from, limb.to);
  if (cellsOf(box).count() <= kFewCells) return list(size(), box);
  pieces_.back().data |= kByParts;
  listLimb(size(), limb.from, limb.to);
}

void PieceGrid::add(PartId part, std::uint32_t number, const Facets& element) {
  pieces_.emplace_back() = {element.box.low, element.box.high, keep(element), part, number};
  if (cellsOf(element.box).count() <= kFewCells) return list(size(), element.box);
  pieces_.back().data |= kByParts;
  for (const auto& t : element.shape->triangles)
    listTriangle(size(), {element.corners[t[0]], element.corners[t[1]], element.corners[t[2]]});
}

void PieceGrid::unpack(std::uint32_t number, std::vector<Nearby::Facet>& facets) const {
  const Piece& piece = pieces_[number - 1];
  const FacetShape& shape = *kinds_[static_cast<std::size_t>(piece.part)].shape;
  const int words = wide({piece.a, piece.b}) ? 6 : 3;
  const std::uint32_t data = piece.data & ~kByParts;
  const std::uint16_t* const pool = corners_[data / kPool].data() + data % kPool;
  const auto corner = [&](std::uint32_t i) {
    const std::uint16_t* const at = pool + static_cast<std::ptrdiff_t>(i) * words;
    if (words == 3) return piece.a + LatticePoint(at[0], at[1], at[2]);
    return piece.a + LatticePoint(at[0] | (at[1] << 16), at[2] | (at[3] << 16), at[4] | (at[5] << 16));
  };
  for (const auto& t : shape.triangles) {
    const LatticeTriangle corners = {corner(t[0]), corner(t[1]), corner(t[2])};
    facets.emplace_back(boxOf(corners), corners);
  }
}

/// visit(number, piece, bounds) for each piece whose bounds meet a box, but those with numbers up to `from`;
/// of one cell the youngest first. `listed` is room to work in.
template <typename Visit>
void PieceGrid::forEachIn(const LatticeBox& box, std::uint32_t from, std::vector<Nearby::Listed>& listed,
                          Visit visit) const {
  const CellBox wanted = cellsOf(box);
  // All of the cells first: pieces lie anywhere in memory, and are waited for together.
  listed.clear();
  forEachCell(wanted.low, wanted.high, [&](Voxel cell) {
    const std::uint32_t block = block_of_[indexIn(blocks_, cell / 2)];
    if (block == 0) return;
    for (std::uint32_t c = contents_[block][inBlock(cell)]; c != 0; c = chunks_[c].older) {
      const auto& numbers = chunks_[c].pieces;
      for (std::size_t i = numbers.size(); i-- > 0;) {
        if (numbers[i] == 0) continue;
        if (numbers[i] <= from) return;  // the older ones too
        __builtin_prefetch(&pieces_[numbers[i] - 1]);
        listed.push_back({cell, numbers[i]});
      }
    }
  });
  std::vector<std::uint32_t> listed_by_parts;
  for (const auto& [cell, number] : listed) {
    const Piece& piece = pieces_[number - 1];
    const LatticeBox bounds = boxOf(piece.a, piece.b);
    if (!meet(bounds, box)) continue;
    // Each once: in the first cell that it shares with the box.
    if ((piece.data & kByParts) == 0) {
      if (cell != glm::max(cellAt(bounds.low), wanted.low)) continue;
    } else {
      if (std::find(listed_by_parts.begin(), listed_by_parts.end(), number) != listed_by_parts.end())
        continue;
      listed_by_parts.push_back(number);
    }
    visit(number, piece, bounds);
  }
}

void PieceGrid::gather(const LatticeBox& box, std::uint32_t from, int but, Nearby& nearby) const {
  nearby.clear();
  nearby.grid_ = this;
  forEachIn(box, from, nearby.listed_,
            [&](std::uint32_t number, const Piece& piece, const LatticeBox& bounds) {
              if (piece.part < 0) {
                nearby.limb_bounds_.emplace_back(bounds);
                nearby.limbs_.push_back(
                    {piece.a, piece.b, -piece.part, static_cast<std::int32_t>(piece.data & ~kByParts)});
              } else if (but < 0 || kinds_[static_cast<std::size_t>(piece.part)].plant != but) {
                nearby.body_bounds_.emplace_back(bounds);
                nearby.bodies_.push_back({{}, number});
              }
            });
}

void PieceGrid::elementsIn(const LatticeBox& box, std::vector<NumberedElement>& found) const {
  thread_local std::vector<Nearby::Listed> listed;
  std::vector<std::uint32_t> numbers;
  forEachIn(box, 0, listed, [&](std::uint32_t number, const Piece& piece, const LatticeBox&) {
    if (piece.part > 0) numbers.push_back(number);
  });
  std::sort(numbers.begin(), numbers.end());
  found.clear();
  for (const std::uint32_t number : numbers) {
    const Piece& piece = pieces_[number - 1];
    found.push_back({kinds_[static_cast<std::size_t>(piece.part)].plant, piece.number});
  }
}

}  // namespace espalier::sim
