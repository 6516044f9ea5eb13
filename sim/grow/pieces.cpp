#include "sim/grow/pieces.h"

#include "sim/base/error.h"
#include "sim/tile/tiling.h"

namespace espalier::sim {

bool place(const PlacedElement& element, const FacetShape& shape, Facets& facets) {
  constexpr double kReach = 16'383.0;  // voxel widths
  facets.shape = &shape;
  facets.corners.clear();
  for (const Vec3 local : shape.corners) {
    const Vec3 corner = placed(element, local);
    for (int axis = 0; axis < 3; ++axis) {
      if (!(corner[axis] > -kReach && corner[axis] < kReach)) return false;
    }
    facets.corners.push_back(latticePoint(corner));
  }
  if (facets.corners.empty()) facets.corners.push_back(latticePoint(element.position_vx));
  facets.box = {facets.corners.front(), facets.corners.front()};
  for (const LatticePoint corner : facets.corners)
    facets.box = {glm::min(facets.box.low, corner), glm::max(facets.box.high, corner)};
  return true;
}

bool inside(Voxel size, const Facets& facets) {
  constexpr auto kOne = static_cast<int>(kFixedOne);
  const LatticePoint low = facets.box.low + kOne / 2, high = facets.box.high + kOne / 2;
  return low.x >= 0 && low.y >= 0 && low.z >= 0 && high.x < size.x * kOne && high.y < size.y * kOne &&
         high.z < size.z * kOne;
}

Limb limbTo(const Plant& plant, NodeId node) {
  const Skeleton& s = plant.skeleton;
  const auto end = static_cast<std::size_t>(node), start = static_cast<std::size_t>(s.parent[end]);
  return {latticePoint(s.position_vx[start]), latticePoint(s.position_vx[end]), plant.stem_part, node};
}

Attachment attachmentOf(const Plant& plant, const PlacedElement& element) {
  return {latticePoint(element.position_vx), plant.stem_part, element.node};
}

void addPlant(const Plant& plant, int number, const std::vector<std::shared_ptr<const FacetShape>>& shapes,
              PieceGrid& pieces) {
  for (std::size_t i = 0; i < plant.shapes.size(); ++i)
    pieces.addPart(plant.element_parts[i], number, shapes[i]);
  for (NodeId node = 1; node < plant.skeleton.size(); ++node) pieces.add(limbTo(plant, node));
  Facets facets;
  for (std::size_t i = 0; i < plant.elements.size(); ++i) {
    const PlacedElement& element = plant.elements[i];
    const auto shape = static_cast<std::size_t>(element.shape);
    if (!place(element, *shapes[shape], facets)) throw BrokenContract("an element stands beyond all worlds");
    pieces.add(plant.element_parts[shape], static_cast<std::uint32_t>(i), facets);
  }
}

}  // namespace espalier::sim
