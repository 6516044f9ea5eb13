#pragma once
#include <vector>

#include "rules/growth/senses.h"
#include "rules/language/rule_set.h"
#include "sim/grow/plant.h"

namespace espalier::rules {

/// The most elements of one shape on one segment.
inline constexpr int kMostOnASegment = 1000;

/// A place for an element on a segment.
struct ElementPlace {
  double along = 0.0;     ///< 0 where the segment begins .. 1 where it ends
  double turn_deg = 0.0;  ///< about the stem, by phyllotaxis
  bool in_order = false;  ///< it is phyllotaxis that says where; else chance does, trial by trial
};

/// Where a limb is in the order of its elements: how far from its plant's seed along its limbs, and a unit
/// vector across it that is carried from the seed on without turning about the limb.
struct LimbPlace {
  double length_vx = 0.0;
  sim::Vec3 across{1, 0, 0};
};

/// The columns that keep it of a plant's nodes, at the ends of their segments: the turn from
/// sim::perpendicular of the segment's way to `across`, in full turns. So that nobody walks the way to the
/// seed.
inline constexpr const char *kLimbTurnColumn = "limb_turn", *kLimbLengthColumn = "limb_vx";
struct LimbQuantities {
  float turn = 0.0f, length_vx = 0.0f;
};

/// Of a node, for a segment of that way (unit) that leaves it; the plant must keep the columns.
LimbPlace limbPlace(const sim::Skeleton& skeleton, sim::NodeId node, sim::Vec3 way);
/// Of a segment's end, from its beginning's.
LimbQuantities atEnd(const LimbPlace& begins, sim::Vec3 way, double length_vx);

/// Places by phyllotaxis on a segment between two lengths along its limb: in their order, at most
/// kMostOnASegment.
std::vector<ElementPlace> placesInOrder(const Phyllotaxis& phyllotaxis, double begins_vx, double ends_vx);

/// Random numbers of an element's trial, by their slots (sim::Slots).
enum ElementSlot : unsigned {
  kAlong,
  kSize,
  kFace,
  kChanceTurn,
  kChanceHeight,
  kOutTurn,
  kOutHeight,
  kPitch,
  kPetiole,
  kSway,
  kTilt,
  kLift
};

/// Farther than this from where it is attached no element is lifted off the surface that it lies on, voxel
/// widths.
inline constexpr double kMostLift = 0.75;

/// Unit, square to the scene's surface that is nearest to a place inside the world, and away from it: as the
/// surface was modelled, where that is known, and else as the distance to it grows. In a guide it is the
/// guide's own. Zero where nothing is near.
sim::Vec3 surfaceNormal(const sim::World& world, sim::Vec3 place_vx);

/// Which way an element's trial stands on its segment; the axes of `element` are set, and its position moved
/// out by the petiole. `stem`: unit, the segment's way; `across`: of LimbPlace; `surface`: of surfaceNormal,
/// which the pose `surface` alone asks for. Free: by phyllotaxis it leaves the stem by the pitch, swaying the
/// more the later the trial; else it points outwards and a little down, as its own weight and its stalk make
/// it. Its face turns towards the open and the light, as a leaf's blade does. In any other pose it turns
/// about what the pose fixes, an axis or a normal, by chance and the farther the later the trial.
void stand(sim::PlacedElement& element, const Element& rule, const ElementPlace& place, sim::Vec3 stem,
           sim::Vec3 across, const Surroundings& around, const Senses& senses, sim::Vec3 surface, int trial,
           sim::Slots& slots);

}  // namespace espalier::rules
