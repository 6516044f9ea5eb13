#include "scenes/prepare/fields.h"

#include <fmt/format.h>

#include "scenes/prepare/site.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

Problem problemOf(const Scene& scene, const FieldSpec& field, const Place& at, const std::string& text) {
  return problemAt(at, scene.file, fmt::format("fields {}: {}", inQuotes(field.name), text));
}

/// Does what a field asks for; what is wrong with it has the place then.
template <typename Work>
void forField(const Scene& scene, const FieldSpec& field, const Place& at, Work work) {
  try {
    work();
  } catch (const sim::InputError& error) {
    throw PlacedError({problemOf(scene, field, at, error.what())});
  }
}

std::vector<std::int64_t> packed(const sim::BitVolume& bits) {
  const sim::Voxel size = bits.size();
  const auto all =
      static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
  std::vector<std::int64_t> words((all + 63) / 64, 0);
  std::size_t index = 0;
  for (int z = 0; z < size.z; ++z) {
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x, ++index) {
        if (bits.at({x, y, z}))
          words[index / 64] |= static_cast<std::int64_t>(std::uint64_t{1} << (index % 64));
      }
    }
  }
  return words;
}

}  // namespace

std::vector<FieldVolume> readFieldGrids(const Scene& scene, std::vector<sim::InputFile>& files,
                                        std::vector<Problem>& warnings) {
  std::vector<FieldVolume> volumes(scene.fields.size());
  Gathering wrong(scene.file);
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const FieldSpec& field = scene.fields[i];
    if (field.file.empty()) continue;
    VectorLattice& grid = volumes[i].grid;
    sim::InputFile read;
    wrong.part([&] {
      forField(scene, field, field.file_place, [&] { grid = readVectorGrid(field.file, field.grid, read); });
    });
    if (!field.told.empty()) read.name = field.told;
    files.push_back(std::move(read));
    if (!grid.coarser) continue;
    warnings.push_back(problemOf(
        scene, field, field.file_place,
        fmt::format("the grid {} has more than {} points and is read at {} x {} x {}, {:.3g} m apart",
                    inQuotes(grid.name), kMostLatticePoints, grid.size[0], grid.size[1], grid.size[2],
                    grid.apart_m)));
  }
  wrong.end();
  return volumes;
}

void findRegions(const Scene& scene, Site& site) {
  Gathering wrong(scene.file);
  for (std::size_t i = 0; i < scene.fields.size(); ++i) {
    const FieldSpec& field = scene.fields[i];
    if (field.within.empty()) continue;
    sim::InsideCells cells;
    wrong.part([&] {
      forField(scene, field, field.within_place,
               [&] { cells = sim::cellsWithin(meshNamed(site, field.within)); });
      if (cells.doubt.doubtful > 0.0)
        site.warnings.push_back(
            problemOf(scene, field, field.within_place, leakOf(field.within, cells.doubt)));
      site.fields[i].region = cells.frame;
      site.fields[i].inside = packed(cells.inside);
    });
  }
  wrong.end();
}

rules::Guide guideOf(const FieldSpec& field, const FieldVolume& volume, const sim::Frame& frame) {
  rules::Guide guide = field.guide;
  guide.orders = {field.order_first, field.order_last};
  guide.points = field.points;
  for (rules::GuidePoint& point : guide.points) {
    point.at = sim::voxelFromWorld(frame, point.at);
    point.radius /= frame.voxel_m;
  }
  if (guide.box) {
    for (sim::Vec3& corner : *guide.box) corner = sim::voxelFromWorld(frame, corner);
  }
  guide.grid = {sim::voxelFromWorld(frame, volume.grid.low_m), volume.grid.apart_m / frame.voxel_m,
                volume.grid.size, volume.grid.vectors};
  if (!volume.inside.empty()) {
    const sim::Frame& cells = volume.region;
    guide.region = {sim::voxelFromWorld(frame, cells.origin_m),
                    cells.voxel_m / frame.voxel_m,
                    {cells.size.x, cells.size.y, cells.size.z},
                    volume.inside};
  }
  return guide;
}

}  // namespace espalier::scenes
