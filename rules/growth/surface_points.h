#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "rules/growth/laid_kinds.h"
#include "sim/grow/columns.h"
#include "sim/world/world.h"

/// How much of a surface is covered: by points that are spread over it evenly.
namespace espalier::rules {

/// Places on surfaces, each of which stands for so much of them; ordered by cells, so that those near a place
/// are found.
struct SurfacePoints {
  std::vector<sim::Vec3> at_vx;
  std::vector<double> area_vx2;
  std::vector<std::int64_t> cell;  ///< ascending
  std::vector<std::int32_t> covered;

  double area() const;
  double coveredArea() const;
};

/// Of the surface that bears things by a book's top rule set and that lies open: a free voxel is above it. It
/// is reached from where things lie already, around no edge that turns by more than diffusion.bend; above is
/// their side. At most so many points, but one for each triangle.
SurfacePoints pointsAround(std::span<const Stance> lying, const sim::SceneSurface& surface,
                           const RuleBook& book, const sim::World& world, double most_points);

/// Marks what lies below an element, as seen from above: of what stands, below all that it is made of. Tells
/// how much of that was not covered before, square voxel widths.
double cover(const sim::PlacedElement& element, const LaidKind& kind, double off_vx, SurfacePoints& points);

/// As columns, for a process to remember.
void keep(const SurfacePoints& points, sim::Columns& memory);
/// The same as cover, of points that were kept.
double coverKept(const sim::PlacedElement& element, const LaidKind& kind, double off_vx,
                 sim::Columns& memory);

}  // namespace espalier::rules
