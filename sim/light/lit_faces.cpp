#include "sim/light/lit_faces.h"

#include <bit>
#include <optional>

#include "sim/base/faces.h"
#include "sim/base/parallel.h"

namespace espalier::sim {
namespace {

/// A face belongs to its voxel's surface if the surface's normal leans to its side at all: the steps of a
/// gentle slope do. What is smaller is rounding.
constexpr float kLean = 1e-3f;

/// Calls work(x) for the voxels of a row that have a free voxel, or the world's edge, at one of their faces.
template <typename Work>
void forEachExposed(const BitVolume& occupied, int y, int z, Work work) {
  const std::uint64_t* const row = occupied.row(y, z);
  const auto word = [&](int dy, int dz, int w) {
    const int ny = y + dy, nz = z + dz;
    const bool inside = ny >= 0 && nz >= 0 && ny < occupied.size().y && nz < occupied.size().z;
    return inside ? occupied.row(ny, nz)[w] : 0;
  };
  for (int w = 0; w < occupied.rowWords() - 1; ++w) {
    const std::uint64_t enclosed = ((row[w] << 1) | (row[w - 1] >> 63)) &
                                   ((row[w] >> 1) | (row[w + 1] << 63)) & word(-1, 0, w) & word(1, 0, w) &
                                   word(0, -1, w) & word(0, 1, w);
    for (std::uint64_t left = row[w] & ~enclosed; left != 0; left &= left - 1)
      work(w * BitVolume::kWordBits + std::countr_zero(left));
  }
}

/// From where a face is judged: from the voxel before it, or where a sheet lies just there, from the next.
std::optional<Voxel> placeOf(std::uint64_t face, const BitVolume& opaque) {
  const Voxel normal = kFaceNormals[face % kFaces];
  Voxel place = voxelOfKey(face, opaque.size()) + normal;
  if (opaque.at(place)) place += normal;
  if (!contains(opaque.size(), place) || opaque.at(place)) return std::nullopt;
  return place;
}

}  // namespace

bool belongs(const Surface& surface, std::uint8_t face) {
  return glm::dot(surface.normal, Vec3f(kFaceNormals[face])) > kLean;
}

Voxel voxelOfKey(std::uint64_t key, Voxel size) {
  std::uint64_t index = key / kFaces;
  const auto nx = static_cast<std::uint64_t>(size.x), nz = static_cast<std::uint64_t>(size.z);
  const int x = static_cast<int>(index % nx);
  index /= nx;
  return {x, static_cast<int>(index / nz), static_cast<int>(index % nz)};
}

std::vector<std::uint64_t> facesByThemselves(const World& world, const Lighting& light) {
  const BitVolume& occupied = world.occupied();
  std::vector<std::vector<std::uint64_t>> slices(static_cast<std::size_t>(occupied.size().y));
  parallelForEach(slices.size(), [&](std::size_t slice) {
    const int y = static_cast<int>(slice);
    for (int z = 0; z < occupied.size().z; ++z) {
      forEachExposed(occupied, y, z, [&](int x) {
        const Voxel v(x, y, z);
        const Surface* const surface =
            light.where->has(v) ? &light.surfaces[light.where->number(v)].surface : nullptr;
        for (std::uint8_t face = 0; face < kFaces; ++face) {
          const Voxel front = v + kFaceNormals[face];
          if (!contains(occupied.size(), front) || occupied.at(front)) continue;
          if (!surface || !belongs(*surface, face)) slices[slice].push_back(light.faceKey(v, face));
        }
      });
    }
  });
  std::vector<std::uint64_t> all;
  for (const auto& slice : slices) all.insert(all.end(), slice.begin(), slice.end());
  return all;
}

void addFaces(SurfaceSensors& sensors, const std::vector<std::uint64_t>& faces, const BitVolume& opaque) {
  if (faces.empty()) return;
  BitVolume bits = sensors.places->bits();
  for (const std::uint64_t face : faces) {
    if (const auto place = placeOf(face, opaque)) bits.set(*place);
  }
  const auto places = std::make_shared<const VoxelSet>(std::move(bits));
  std::vector<std::uint32_t> renumbered;
  renumbered.reserve(sensors.places->count());
  for (const Voxel v : sensors.places->voxels())
    renumbered.push_back(static_cast<std::uint32_t>(places->number(v)));
  for (auto& piece : sensors.taps) {
    for (auto& tap : piece) tap.place = renumbered[tap.place];
  }
  sensors.places = places;
  sensors.surfaces.reserve(sensors.surfaces.size() + faces.size());
  sensors.own.reserve(sensors.own.size() + faces.size());
  const auto piece = static_cast<std::uint32_t>(sensors.taps.size());
  std::vector<SurfaceSensors::Tap>& taps = sensors.taps.emplace_back();
  taps.reserve(faces.size());
  for (const std::uint64_t face : faces) {
    Surface surface;
    surface.normal = Vec3f(kFaceNormals[face % kFaces]);
    sensors.surfaces.push_back({voxelOfKey(face, opaque.size()), surface});
    const auto first = static_cast<std::uint32_t>(taps.size());
    if (const auto place = placeOf(face, opaque))
      taps.push_back({static_cast<std::uint32_t>(places->number(*place)), 1.0f});
    sensors.own.push_back({piece, first, static_cast<std::uint32_t>(taps.size()) - first});  // none: dark
  }
}

}  // namespace espalier::sim
