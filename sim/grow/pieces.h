#pragma once
#include "sim/grow/plant.h"
#include "sim/sense/piece_grid.h"

/// Plants as pieces that are tested exactly.
namespace espalier::sim {

/// An element's facets in its place. False, and they mean nothing, where a corner lies beyond what tiling's
/// lattice holds (16,384 voxels). `facets` keeps its memory, and borrows `shape`.
bool place(const PlacedElement& element, const FacetShape& shape, Facets& facets);

/// Whether facets lie wholly inside a world of that size.
bool inside(Voxel size, const Facets& facets);

/// The limb that ends in a node; the node must have a parent.
Limb limbTo(const Plant& plant, NodeId node);

/// Where an element is attached.
Attachment attachmentOf(const Plant& plant, const PlacedElement& element);

/// Makes a plant's parts known and adds all that it has. Throws BrokenContract for an element beyond the
/// lattice. `shapes`: of Plant::shapes.
void addPlant(const Plant& plant, int number, const std::vector<std::shared_ptr<const FacetShape>>& shapes,
              PieceGrid& pieces);

}  // namespace espalier::sim
