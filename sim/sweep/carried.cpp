#include "sim/sweep/carried.h"

#include <algorithm>
#include <cstring>

#include "sim/base/parallel.h"

namespace espalier::sim {

namespace {

/// The stops with a free voxel, or the world's edge, before a face.
BitVolume open(const BitVolume& stops, Voxel before) {
  BitVolume result(stops.size());
  const Voxel size = stops.size();
  parallelForEach(static_cast<std::size_t>(size.y), [&](std::size_t slice) {
    const int y = static_cast<int>(slice), oy = y + before.y;
    for (int z = 0; z < size.z; ++z) {
      const int oz = z + before.z;
      const bool inside = oy >= 0 && oy < size.y && oz >= 0 && oz < size.z;
      for (int w = 0; w < stops.rowWords() - 1; ++w) {
        const int x = w * BitVolume::kWordBits + before.x;
        result.row(y, z)[w] = stops.row(y, z)[w] & ~(inside ? stops.from({x, oy, oz}) : 0);
      }
    }
  });
  return result;
}

}  // namespace

template <typename Value>
Stops<Value>::Stops(BitVolume of) : where(std::move(of)) {
  for (std::size_t f = 0; f < kFaces; ++f) {
    OfFace& face = faces[f];
    face.where = VoxelSet(open(where, kFaceNormals[f]));
    face.x.reserve(face.where.count());
    for (const Voxel v : face.where.voxels()) face.x.push_back(v.x);
    face.values.resize(face.where.count());
    for (int y = 0; y < where.size().y; ++y) {
      face.first_row.push_back(face.rows.size());
      for (int z = 0; z < where.size().z; ++z) {
        if (face.where.firstOfRow(y, z) < face.where.firstOfRow(y, z + 1)) face.rows.push_back(z);
      }
    }
    face.first_row.push_back(face.rows.size());
  }
}

std::vector<std::uint8_t> facesEntered(const LatticeDirection& direction) {
  std::vector<std::uint8_t> faces;
  Voxel before(0);
  for (const Voxel o : direction.crossed) {
    const auto face = std::find(kFaceNormals.begin(), kFaceNormals.end(), before - o);
    faces.push_back(static_cast<std::uint8_t>(face - kFaceNormals.begin()));
    before = o;
  }
  return faces;
}

template <typename Value>
CarriedSweep<Value>::CarriedSweep(const Stops<Value>& stops, const LatticeDirection& direction, Value open)
    : stops_(stops),
      size_(stops.where.size()),
      v_(direction.v),
      crossed_(direction.crossed),
      faces_(facesEntered(direction)),
      open_(open),
      slots_(std::min(std::abs(v_.y) + 1, size_.y)),
      seen_(static_cast<std::size_t>(slots_) * static_cast<std::size_t>(size_.z) *
                static_cast<std::size_t>(size_.x),
            open),
      filled_(static_cast<std::size_t>(slots_) * static_cast<std::size_t>(size_.z)) {}

template <typename Value>
void CarriedSweep<Value>::run(int y) {
  last_ = y;
  if (v_.y == 0) {
    runLevel(y);
    return;
  }
  for (int z = 0; z < size_.z; ++z) takeEnd(y, z);
  // The nearest last: it hides the others. One with another stop before its face is hidden by that.
  for (std::size_t i = crossed_.size(); i-- > 0;) {
    const int oy = y + crossed_[i].y;
    if (oy < 0 || oy >= size_.y) continue;
    const typename Stops<Value>::OfFace& face = stops_.faces[faces_[i]];
    const auto slice = static_cast<std::size_t>(oy);
    for (std::size_t row = face.first_row[slice]; row < face.first_row[slice + 1]; ++row)
      takeStops(i, y, face.rows[row] - crossed_[i].z);
  }
}

/// A slice of a direction that stays in it, row by row: they depend on each other.
template <typename Value>
void CarriedSweep<Value>::runLevel(int y) {
  for (int row = 0; row < size_.z; ++row) {
    const int z = v_.z > 0 ? size_.z - 1 - row : row;
    takeEnd(y, z);
    for (std::size_t i = crossed_.size(); i-- > 0;) {
      const int oz = z + crossed_[i].z;
      if (oz >= 0 && oz < size_.z) takeStops(i, y, z);
    }
    if (v_.z != 0) continue;
    alongRow(y, z, at(y, z));
    filled_[rowIndex(y, z)] = 1;
  }
}

/// What the period's end sees, if that lies in the world: a ray that has left does not come back.
template <typename Value>
void CarriedSweep<Value>::takeEnd(int y, int z) {
  Value* const to = at(y, z);
  std::uint8_t& filled = filled_[rowIndex(y, z)];
  const int ey = y + v_.y, ez = z + v_.z;
  const int low = std::max(0, -v_.x), high = std::min(size_.x, size_.x - v_.x);
  const bool own_row = v_.y == 0 && v_.z == 0;
  if (own_row || ey < 0 || ey >= size_.y || ez < 0 || ez >= size_.z || low >= high ||
      filled_[rowIndex(ey, ez)] == 0) {
    if (filled != 0) std::fill_n(to, size_.x, open_);
    filled = 0;
    return;
  }
  std::fill(to, to + low, open_);
  std::memcpy(to + low, at(ey, ez) + (low + v_.x), static_cast<std::size_t>(high - low) * sizeof(Value));
  std::fill(to + high, to + size_.x, open_);
  filled = 1;
}

/// What one of the voxels crossed holds for a row from which it is crossed.
template <typename Value>
void CarriedSweep<Value>::takeStops(std::size_t crossed, int y, int z) {
  if (z < 0 || z >= size_.z) return;
  const Voxel o = crossed_[crossed];
  const typename Stops<Value>::OfFace& face = stops_.faces[faces_[crossed]];
  const std::size_t end = face.where.firstOfRow(y + o.y, z + o.z + 1);
  Value* const to = at(y, z);
  for (std::size_t k = face.where.firstOfRow(y + o.y, z + o.z); k < end; ++k) {
    const int x = face.x[k] - o.x;
    if (x >= 0 && x < size_.x) to[x] = face.values[k];
  }
  filled_[rowIndex(y, z)] = 1;
}

/// Along x a row depends on itself: where the next voxel is no stop, what that one sees is seen.
template <typename Value>
void CarriedSweep<Value>::alongRow(int y, int z, Value* to) const {
  const BitVolume& stops = stops_.where;
  for (int i = 1; i < size_.x; ++i) {
    const int x = v_.x > 0 ? size_.x - 1 - i : i;
    if (!stops.at({x + v_.x, y, z})) to[x] = to[x + v_.x];
  }
}

template struct Stops<std::uint16_t>;
template struct Stops<std::uint32_t>;
template class CarriedSweep<std::uint16_t>;
template class CarriedSweep<std::uint32_t>;

namespace {

/// Directions that are swept side by side, so that a slice of sums stays in the cache for all of them.
constexpr std::size_t kAtOnce = 8;

/// Adds what a few directions of one kind see to the sums.
void addSeen(const Stops<std::uint16_t>& stops, const DirectionSet& directions,
             const std::vector<std::size_t>& batch, std::vector<std::uint32_t>& sums) {
  const Voxel size = stops.where.size();
  std::vector<CarriedSweep<std::uint16_t>> sweeps;
  for (const std::size_t d : batch) sweeps.emplace_back(stops, directions[d], std::uint16_t{0});
  const auto nx = static_cast<std::size_t>(size.x), slice = nx * static_cast<std::size_t>(size.z);
  for (int i = 0; i < size.y; ++i) {
    const int y = sweeps.front().downwards() ? size.y - 1 - i : i;
    for (auto& sweep : sweeps) sweep.run(y);
    for (int z = 0; z < size.z; ++z) {
      std::uint32_t* const sum =
          sums.data() + static_cast<std::size_t>(y) * slice + static_cast<std::size_t>(z) * nx;
      for (std::size_t k = 0; k < sweeps.size(); ++k) {
        const std::uint16_t* const seen = sweeps[k].row(z);
        if (!seen) continue;
        const std::uint32_t weight = directions[batch[k]].weight;
        for (std::size_t x = 0; x < nx; ++x) sum[x] += weight * seen[x];
      }
    }
  }
}

}  // namespace

Field<std::uint16_t> carriedSum(const Stops<std::uint16_t>& stops, const DirectionSet& directions) {
  const Voxel size = stops.where.size();
  std::vector<std::vector<std::size_t>> batches;
  for (const bool downwards : {true, false}) {
    std::vector<std::size_t> batch;
    for (std::size_t d = 0; d < directions.size(); ++d) {
      if (directions[d].weight == 0 || (directions[d].v.y >= 0) != downwards) continue;
      batch.push_back(d);
      if (batch.size() < kAtOnce) continue;
      batches.push_back(std::move(batch));
      batch.clear();
    }
    if (!batch.empty()) batches.push_back(std::move(batch));
  }
  const std::size_t count =
      static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
  // Whole numbers: in what order threads add theirs does not matter.
  const std::size_t shares = std::clamp<std::size_t>(static_cast<std::size_t>(threadCount()), 1,
                                                     std::max<std::size_t>(1, batches.size()));
  std::vector<std::vector<std::uint32_t>> sums(shares);
  parallelForEach(shares, [&](std::size_t share) {
    sums[share].resize(count);
    for (std::size_t b = share; b < batches.size(); b += shares)
      addSeen(stops, directions, batches[b], sums[share]);
  });
  Field<std::uint16_t> field{size, std::vector<std::uint16_t>(count)};
  parallelForEach(static_cast<std::size_t>(size.y), [&](std::size_t slice) {
    constexpr std::uint32_t kWhole = ExposureField::kWhole;
    const int y = static_cast<int>(slice);
    for (int z = 0; z < size.z; ++z) {
      const std::uint64_t* const stop = stops.where.row(y, z);
      std::size_t i = field.index({0, y, z});
      for (int x = 0; x < size.x; ++x, ++i) {
        if (((stop[x >> 6] >> (x & 63)) & 1u) != 0) continue;
        std::uint32_t sum = 0;
        for (const auto& share : sums) sum += share[i];
        field.values[i] = static_cast<std::uint16_t>((std::uint64_t{sum} + kWhole / 2) / kWhole);
      }
    }
  });
  return field;
}

}  // namespace espalier::sim
