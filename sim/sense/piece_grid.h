#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "sim/base/pages.h"
#include "sim/sense/crossing.h"
#include "sim/world/world.h"

/// What of all plants is near, exactly: limbs as straight lines, elements as triangles.
namespace espalier::sim {

/// A shape's polygons, as triangles of the fans that tiling makes of them.
struct FacetShape {
  std::vector<Vec3> corners;  ///< local frame, each once
  std::vector<CornerNumbers> triangles;
};

/// Polygons of three or more corners each.
FacetShape facetShape(const std::vector<std::vector<Vec3>>& polygons);

/// An element in its place.
struct Facets {
  const FacetShape* shape = nullptr;  ///< borrowed
  std::vector<LatticePoint> corners;
  LatticeBox box;
};

struct Limb {
  LatticePoint from{0}, to{0};
  PartId stem = kFree;    ///< of its plant
  std::int32_t node = 0;  ///< in which it ends
};

/// Where an element is attached: the limbs that it may touch there are no obstacle.
struct Attachment {
  LatticePoint at{0};      ///< limbs that begin or end here
  PartId stem = kFree;     ///< and the one of this plant
  std::int32_t node = -1;  ///< that ends in this node
};

class PieceGrid;

/// Which element of which plant.
struct NumberedElement {
  int plant = 0;             ///< as addPart was told
  std::uint32_t number = 0;  ///< among all of its plant

  friend bool operator==(const NumberedElement&, const NumberedElement&) = default;
};

/// Pieces that lie near each other, ready for many questions. Keeps its memory from one to the next.
class Nearby {
 public:
  void clear();
  void add(const Facets& element);

  /// Whether an element clashes with one of the pieces: a polygon of it crosses one of another element, or a
  /// limb pierces it.
  bool clash(const Facets& element, const Attachment& attachment);
  /// Whether a limb pierces one of the elements.
  bool clash(const Limb& limb);
  /// The limbs among them, in no order.
  std::span<const Limb> limbs() const { return limbs_; }

 private:
  friend class PieceGrid;
  // Four numbers a corner, the last one 0: a vector's lanes.
  struct Bounds {
    Bounds() = default;
    explicit Bounds(const LatticeBox& box) : low(box.low, 0), high(box.high, 0) {}
    alignas(16) glm::ivec4 low{0};
    alignas(16) glm::ivec4 high{0};
  };
  struct Facet {
    Facet(const LatticeBox& box, const LatticeTriangle& t);
    Bounds bounds;
    LatticeTriangle corners;
    glm::i64vec3 normal;
  };
  // All corners lie between two planes.
  struct Slab {
    Vec3 normal{0.0};  // unit; zero: unknown
    double low = 0.0, high = 0.0;
  };
  struct Body {
    Slab slab;
    std::uint32_t number = 0;           // of the piece in the grid; 0: none
    std::uint32_t first = 0, last = 0;  // of facets_, once it is open
  };

  // A piece of the grid, as a cell lists it.
  struct Listed {
    Voxel cell;
    std::uint32_t number;
  };

  static bool apart(const Bounds& a, const Bounds& b);
  static bool apart(const Slab& slab, std::span<const Facet> facets);
  static bool apart(const Slab& slab, const Facets& element);
  static Slab slabOf(std::span<const Facet> facets);
  void open(Body& body);
  bool cross(const Body& body, bool near) const;

  const PieceGrid* grid_ = nullptr;
  std::vector<Listed> listed_;
  std::vector<Bounds> limb_bounds_;
  std::vector<Limb> limbs_;
  std::vector<Bounds> body_bounds_;
  std::vector<Body> bodies_;
  std::vector<Facet> facets_;  // of bodies that were looked at
  std::vector<Facet> asked_;   // of the element that is asked of
  Slab asked_slab_;
};

/// The limbs and elements of all plants, by place. Pieces are added and never removed; const members may be
/// called from any number of threads meanwhile nothing is added.
class PieceGrid {
 public:
  /// Pieces may lie beyond a world of this size; they are found there too.
  explicit PieceGrid(Voxel size);

  /// Elements of a part and of a plant have these facets. A part is known once.
  void addPart(PartId part, int plant, std::shared_ptr<const FacetShape> shape);
  /// Throws BrokenContract for a part that is not known.
  const FacetShape& shapeOf(PartId part) const;

  void add(const Limb& limb);
  /// `number`: of its plant's elements.
  void add(PartId part, std::uint32_t number, const Facets& element);
  /// Pieces so far: what is added from now on has numbers from here on.
  std::uint32_t size() const { return static_cast<std::uint32_t>(pieces_.size()); }

  /// Finds the pieces whose bounds meet a box, but those with numbers below `from`, and the elements of plant
  /// `but` (-1: none). `nearby` holds them instead of what it held, until something is added to the grid.
  void gather(const LatticeBox& box, std::uint32_t from, int but, Nearby& nearby) const;
  /// Those of them that are elements, in the order in which they were added. Replaces what `found` held.
  void elementsIn(const LatticeBox& box, std::vector<NumberedElement>& found) const;

 private:
  friend class Nearby;
  // A limb from `a` to `b`, or an element with the bounds `a` and `b`. Numbers count from 1.
  struct Piece {
    LatticePoint a{0}, b{0};
    std::uint32_t data = 0;    // a limb's node; where an element's corners stand; bit 31: listed part by part
    PartId part = kFree;       // of an element; of a limb's stem, negative
    std::uint32_t number = 0;  // of an element
  };
  // Numbers of pieces that touch a cell, in order, 0 where there is room; the youngest chunk is the first.
  struct Chunk {
    std::array<std::uint32_t, 7> pieces{};
    std::uint32_t older = 0;
  };
  using Block = std::array<std::uint32_t, 8>;  // the first chunk of each of its 2 x 2 x 2 cells
  struct Kind {
    int plant = -1;
    std::shared_ptr<const FacetShape> shape;
  };
  struct CellBox {
    Voxel low, high;
    int count() const;
  };

  Voxel cellAt(LatticePoint p) const;
  CellBox cellsOf(const LatticeBox& box) const;
  void list(std::uint32_t number, const LatticeBox& box);
  void listLimb(std::uint32_t number, LatticePoint from, LatticePoint to);
  void listTriangle(std::uint32_t number, const LatticeTriangle& triangle);
  std::uint32_t keep(const Facets& element);
  template <typename Visit>
  void forEachIn(const LatticeBox& box, std::uint32_t from, std::vector<Nearby::Listed>& listed,
                 Visit visit) const;
  void unpack(std::uint32_t number, std::vector<Nearby::Facet>& facets) const;

  Voxel cells_, blocks_;
  std::vector<std::uint32_t> block_of_;  // by place; 0: nothing there
  Pages<Block> contents_{1};
  Pages<Chunk> chunks_{1};
  Pages<Piece> pieces_{0};
  std::deque<std::vector<std::uint16_t>> corners_;
  std::vector<Kind> kinds_;  // by part
};

}  // namespace espalier::sim
