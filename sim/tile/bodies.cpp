#include "sim/tile/bodies.h"

#include <algorithm>
#include <bit>

#include "sim/base/stop.h"

namespace espalier::sim {
namespace {

/// Calls visit(word, bits) for the words of a row that a run lies in.
template <typename Visit>
void forEachWord(const Run& run, Visit visit) {
  constexpr int kBits = BitVolume::kWordBits;
  for (int w = run.first / kBits; w <= run.last / kBits; ++w) {
    const int low = std::max(run.first - w * kBits, 0), high = std::min(run.last - w * kBits, kBits - 1);
    visit(w, (~std::uint64_t{0} >> (kBits - 1 - (high - low))) << low);
  }
}

}  // namespace

Bodies::Bodies(const BitVolume& voxels, const BitVolume& but, int foot) {
  const Voxel size = voxels.size();
  for (int y = foot; y < size.y; ++y) {
    throwIfStopped();
    for (int z = 0; z < size.z; ++z) {
      const std::size_t row_begin = runs_.size();
      for (int w = 0; w < voxels.rowWords() - 1; ++w) {
        std::uint64_t left = voxels.row(y, z)[w] & ~but.row(y, z)[w];
        while (left != 0) {
          const int begin = std::countr_zero(left), length = std::countr_one(left >> begin);
          const int x = w * BitVolume::kWordBits + begin;
          if (runs_.size() == row_begin || runs_.back().last + 1 != x) runs_.push_back({y, z, x, x});
          runs_.back().last = x + length - 1;
          if (begin + length >= BitVolume::kWordBits) break;
          left &= ~std::uint64_t{0} << (begin + length);
        }
      }
      ends_.push_back(runs_.size());
    }
  }
  bodies_ = Sets(runs_.size());
  const auto z_rows = static_cast<std::size_t>(size.z);
  for (std::size_t row = 0; row < ends_.size(); ++row) {
    if (row % z_rows != 0) joinRows(row, row - 1);
    if (row >= z_rows) joinRows(row, row - z_rows);
  }
}

void Bodies::joinRows(std::size_t row, std::size_t other) {
  const auto begin = [&](std::size_t r) { return r == 0 ? 0 : ends_[r - 1]; };
  std::size_t from = begin(other);
  for (std::size_t i = begin(row); i < ends_[row]; ++i) {
    while (from < ends_[other] && runs_[from].last < runs_[i].first) ++from;
    for (std::size_t k = from; k < ends_[other] && runs_[k].first <= runs_[i].last; ++k)
      bodies_.join(k, i);
  }
}

std::size_t countIn(const BitVolume& voxels, const Run& run) {
  std::size_t count = 0;
  forEachWord(run, [&](int w, std::uint64_t bits) {
    count += static_cast<std::size_t>(std::popcount(voxels.row(run.y, run.z)[w] & bits));
  });
  return count;
}

void setRun(BitVolume& voxels, const Run& run) {
  forEachWord(run, [&](int w, std::uint64_t bits) { voxels.row(run.y, run.z)[w] |= bits; });
}

}  // namespace espalier::sim
