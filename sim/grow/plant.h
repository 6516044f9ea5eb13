#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/picture.h"
#include "sim/base/vec.h"
#include "sim/grow/stem_form.h"
#include "sim/grow/stem_girth.h"
#include "sim/sense/intersection.h"
#include "sim/world/world.h"

namespace espalier::sim {

using NodeId = std::int32_t;
inline constexpr NodeId kNoNode = -1;

/// The tree of a plant's nodes; a segment joins a node to its parent. Data lie in arrays keyed by node, and a
/// parent's number is always lower than its child's.
struct Skeleton {
  std::vector<NodeId> parent;  ///< kNoNode for a seed
  std::vector<Vec3> position_vx;
  std::vector<std::int32_t> born;  ///< iteration in which the node was placed
  /// What else the plant's process says of each node, by name: "exposure", "proximity_vx". Which there are is
  /// the process's business; everybody else takes them as they come, in the order of their names.
  std::map<std::string, std::vector<float>, std::less<>> columns;

  NodeId size() const { return static_cast<NodeId>(parent.size()); }
};

/// The column of radii that are given, of the segment that ends in each node: what models then take, in place
/// of what the plant's girth makes of its skeleton. A seed's own means nothing.
inline constexpr const char* kRadiusColumn = "radius_vx";

/// The column of plants whose limbs meet: of a node that closes a loop the number of the one whose place it
/// stands in, and 0 of all others. Exact below 2^24.
inline constexpr const char* kJoinsColumn = "joins";

/// The column of that name; null where the plant's process keeps none.
inline const std::vector<float>* find(const Skeleton& skeleton, std::string_view name) {
  const auto at = skeleton.columns.find(name);
  return at == skeleton.columns.end() ? nullptr : &at->second;
}

/// How far the colours of a shape's elements differ, each 0 (not at all) or more; by default as
/// leaves mostly do.
struct ColourVariation {
  double by_chance = 1.0;  ///< each its own shade and hue
  double by_age = 1.0;     ///< what is young is lighter
  double by_light = 1.0;   ///< what grew in the light is warmer and brighter
  double by_height = 0.0;  ///< what is high on its plant goes from green to gold
};

/// A shape that is placed on a plant: a leaf, a flower. Local frame: the element is attached at the origin,
/// grows along +y, and shows its face to +z.
struct ElementShape {
  std::string name;
  std::vector<std::vector<Vec3>> polygons;  ///< corners in order; unit: voxel widths at scale 1
  Colour colour{0.15f, 0.35f, 0.08f};       ///< linear RGB
  ColourVariation varies = {};
  /// What is painted on its polygons: a kind of leaf, or a picture that was read, across their extent in x
  /// and y. Without either they have the colour alone. Growth does not look at it.
  std::string drawn = {};
  std::shared_ptr<const Picture> picture = nullptr;
  bool body = false;   ///< its polygons close a body, such as a stone: no light comes through it
  Colour emits{0.0f};  ///< light that it sends out by itself, linear; growth does not look at it
  float alpha = 1.0f;  ///< how much it hides of what is behind it, 0..1; growth and light do not look at it
};

struct PlacedElement {
  NodeId node = kNoNode;   ///< stands on the segment between this node and its parent; of a seed: by itself
  std::int32_t shape = 0;  ///< index into Plant::shapes
  Vec3 position_vx{0.0};
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  ///< orthonormal, right-handed: local axes in voxel space
  double scale = 1.0;
  float exposure = 0.0f;
  std::int32_t born = 0;
};

inline Vec3 placed(const PlacedElement& e, Vec3 local) {
  return e.position_vx + e.scale * (local.x * e.x + local.y * e.y + local.z * e.z);
}

struct Plant {
  std::string name;
  Skeleton skeleton;
  std::vector<ElementShape> shapes;
  std::vector<PlacedElement> elements;
  Colour stem_colour{0.16f, 0.10f, 0.05f};
  std::optional<Colour> shoot_colour = {};  ///< of what grew last; none: greener than the rest
  std::string bark =
      {};  ///< what is painted on its stems, as on ElementShape: a kind of bark, or a picture that tiles
  std::shared_ptr<const Picture> bark_picture = nullptr;
  Colour stem_emits{0.0f};        ///< as ElementShape::emits
  float stem_emits_share = 1.0f;  ///< what of it is left with each order of branching
  float stem_alpha = 1.0f;        ///< as ElementShape::alpha
  StemGirth girth;
  StemForm form;
  PartId stem_part = kFree;
  std::vector<PartId> element_parts;  ///< a part for each shape
  std::uint64_t key = 0;              ///< its seed's: what its random numbers follow from
};

/// What its parts call it (Part::plant); kNoPlant where it has none in the world.
inline int numberOf(const World& world, const Plant& plant) {
  return plant.stem_part == kFree ? kNoPlant : world.part(plant.stem_part).plant;
}

}  // namespace espalier::sim
