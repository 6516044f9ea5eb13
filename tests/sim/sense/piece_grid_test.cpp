#include "sim/sense/piece_grid.h"

#include <gtest/gtest.h>

#include <random>

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/tile/tiling.h"

namespace espalier::sim {
namespace {

constexpr int kPlants = 3;
constexpr PartId kLeaf = 10, kSail = 20, kStem = 30;  // and the plant's number

/// Some pieces in a world, most of them small, some that reach across it and beyond.
class Heap {
 public:
  explicit Heap(int pieces, unsigned seed) : random_(seed) {
    leaf_ = std::make_shared<FacetShape>(facetShape(
        {{{0, .1, 0}, {-.5, .6, -.1}, {0, 1, 0}}, {{0, .1, 0}, {0, 1, 0}, {.4, .6, -.1}, {.3, .2, -.1}}}));
    sail_ = std::make_shared<FacetShape>(facetShape({{{0, 0, 0}, {18, 0, 0}, {18, 30, 0}, {0, 30, 0}}}));
    for (int plant = 0; plant < kPlants; ++plant) {
      grid.addPart(kLeaf + plant, plant, leaf_);
      grid.addPart(kSail + plant, plant, sail_);
    }
    for (int i = 0; i < pieces; ++i) {
      const int plant = i % kPlants;
      if (i % 4 == 0) {
        const Vec3 from = place(), to = i % 40 == 0 ? place() : from + 2.0 * way();
        limbs.push_back({latticePoint(from), latticePoint(to), kStem + plant, i});
        grid.add(limbs.back());
      } else {
        elements.emplace_back(plant, element(i % 50 == 1 ? sail_ : leaf_));
        grid.add((i % 50 == 1 ? kSail : kLeaf) + plant, static_cast<std::uint32_t>(elements.size() - 1),
                 elements.back().second);
      }
      order.push_back(i % 4 == 0);
    }
  }

  double uniform() { return static_cast<double>(random_()) / 4294967296.0; }
  Vec3 place() {
    const double x = uniform(), y = uniform(), z = uniform();
    return Vec3(x, y, z) * Vec3(kSize) - 0.5;
  }
  Vec3 way() {
    const double turn = uniform(), height = uniform();
    return inCone({0, 1, 0}, -1.0, turn, height);
  }
  Facets element(const std::shared_ptr<const FacetShape>& shape) {
    const Vec3 at = place(), z = way(), x = perpendicular(z), y = glm::cross(z, x);
    const double scale = 0.5 + uniform();
    Facets facets;
    facets.shape = shape.get();
    for (const Vec3 c : shape->corners) {
      facets.corners.push_back(latticePoint(at + scale * (c.x * x + c.y * y + c.z * z)));
      const LatticePoint corner = facets.corners.back();
      facets.box = facets.corners.size() == 1
                       ? LatticeBox{corner, corner}
                       : LatticeBox{glm::min(facets.box.low, corner), glm::max(facets.box.high, corner)};
    }
    return facets;
  }
  static std::vector<LatticeTriangle> trianglesOf(const Facets& facets) {
    std::vector<LatticeTriangle> triangles;
    for (const auto& t : facets.shape->triangles)
      triangles.push_back({facets.corners[t[0]], facets.corners[t[1]], facets.corners[t[2]]});
    return triangles;
  }
  /// Asked of all pieces from number `from` on.
  bool clashes(const Facets& facets, const Attachment& attachment, std::uint32_t from) const {
    std::size_t limb = 0, element = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool asked = i >= from;
      if (order[i]) {
        const Limb& l = limbs[limb++];
        if (!asked || l.from == attachment.at || l.to == attachment.at ||
            (l.stem == attachment.stem && l.node == attachment.node))
          continue;
        for (const auto& t : trianglesOf(facets)) {
          if (pierces(l.from, l.to, t)) return true;
        }
      } else {
        const Facets& other = elements[element++].second;
        if (!asked) continue;
        for (const auto& t : trianglesOf(facets)) {
          for (const auto& u : trianglesOf(other)) {
            if (cross(t, u)) return true;
          }
        }
      }
    }
    return false;
  }

  static constexpr Voxel kSize{40, 24, 33};
  PieceGrid grid{kSize};
  std::vector<Limb> limbs;
  std::vector<std::pair<int, Facets>> elements;  // by plant
  std::vector<bool> order;                       // limbs
  std::shared_ptr<const FacetShape> leaf_, sail_;

 private:
  std::mt19937 random_;
};

TEST(PieceGrid, AnswersAsAllPiecesWould) {
  for (const int pieces : {0, 1200, 5000}) {
    Heap heap(pieces, 7);
    EXPECT_EQ(heap.grid.size(), static_cast<std::uint32_t>(pieces));
    int clashing = 0;
    Nearby nearby;
    for (int i = 0; i < 1500; ++i) {
      const Facets trial = heap.element(i % 10 ? heap.leaf_ : heap.sail_);
      const std::uint32_t from = i % 3 ? 0 : heap.grid.size() * 4 / 5;
      Attachment attachment;
      if (pieces > 0) {
        const Limb& limb = heap.limbs[static_cast<std::size_t>(i) % heap.limbs.size()];
        attachment = {limb.from, limb.stem, limb.node + 4 * kPlants};
      }
      heap.grid.gather(trial.box, from, -1, nearby);
      const bool expected = heap.clashes(trial, attachment, from);
      ASSERT_EQ(nearby.clash(trial, attachment), expected) << i;
      clashing += expected;
      // What was gathered for more answers the same for less.
      heap.grid.gather({trial.box.low - 5000, trial.box.high + 9000}, from, -1, nearby);
      ASSERT_EQ(nearby.clash(trial, attachment), expected) << i;
    }
    if (pieces > 0) {
      EXPECT_GT(clashing, 200);
      EXPECT_LT(clashing, 1300);
    }
  }
}

TEST(PieceGrid, NumbersTheElementsInABox) {
  Heap heap(3000, 5);
  std::vector<NumberedElement> found, expected;
  std::size_t most = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 low = heap.place();
    const LatticeBox box{latticePoint(low), latticePoint(low + (i % 10 == 0 ? 20.0 : 3.0))};
    heap.grid.elementsIn(box, found);
    expected.clear();
    for (std::size_t k = 0; k < heap.elements.size(); ++k) {
      if (meet(heap.elements[k].second.box, box))
        expected.push_back({heap.elements[k].first, static_cast<std::uint32_t>(k)});
    }
    // What is listed part by part is found where its parts are.
    EXPECT_TRUE(std::includes(expected.begin(), expected.end(), found.begin(), found.end(),
                              [](const auto& a, const auto& b) { return a.number < b.number; }));
    for (const NumberedElement& one : expected) {
      const Facets& facets = heap.elements[one.number].second;
      const bool small = facets.shape == heap.leaf_.get();
      EXPECT_TRUE(!small || std::count(found.begin(), found.end(), one) == 1);
    }
    most = std::max(most, found.size());
  }
  EXPECT_GT(most, 30u);
}

TEST(PieceGrid, ALimbIsHinderedByElementsButThoseOfOnePlant) {
  Heap heap(4000, 9);
  int clashing = 0;
  Nearby nearby;
  for (int i = 0; i < 1500; ++i) {
    const Vec3 from = heap.place();
    const Limb limb{latticePoint(from), latticePoint(i % 10 ? from + 2.0 * heap.way() : heap.place())};
    const int but = i % (kPlants + 1) - 1;
    bool expected = false;
    for (const auto& [plant, element] : heap.elements) {
      if (plant == but) continue;
      for (const auto& t : Heap::trianglesOf(element)) expected = expected || pierces(limb.from, limb.to, t);
    }
    heap.grid.gather(boxOf(limb.from, limb.to), 0, but, nearby);
    ASSERT_EQ(nearby.clash(limb), expected);
    clashing += expected;
  }
  EXPECT_GT(clashing, 200);
  EXPECT_LT(clashing, 1300);
}

TEST(PieceGrid, APartThatIsNotKnownIsSaid) {
  PieceGrid grid({4, 4, 4});
  EXPECT_THROW(grid.shapeOf(3), BrokenContract);
  EXPECT_THROW(grid.shapeOf(-1), BrokenContract);
}

}  // namespace
}  // namespace espalier::sim
