#pragma once
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rules/language/emission.h"
#include "rules/language/envelope_spec.h"
#include "rules/language/value.h"
#include "sim/base/vec.h"
#include "sim/grow/plant.h"
#include "sim/grow/stem_form.h"
#include "sim/grow/stem_girth.h"

/// Rule sets as plain values: what a rule file says. rules/language/registry.h describes every key (type,
/// unit, default, range, meaning); the reader, the JSON Schema and the reference page are derived from it.
namespace espalier::rules {

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();
inline constexpr int kNoAge = 1'000'000;  ///< iterations or segments: beyond all that grows

/// A length as it was written: in voxel widths, or in metres until a job's voxel size is known
/// (rules/growth/voxel_widths.h). What grows by a rule set sees voxel widths alone.
struct Length {
  Value value;
  bool metres = false;
  friend bool operator==(const Length&, const Length&) = default;
};

/// A length that is one number.
struct Distance {
  double number = 0.0;
  bool metres = false;
  friend bool operator==(const Distance&, const Distance&) = default;
};

/// Flat polygons by their corners.
struct Polygons {
  std::vector<std::vector<sim::Vec3>> corners;
  bool metres = false;
  friend bool operator==(const Polygons&, const Polygons&) = default;
};

/// What the angle between a trial and its limb's way is drawn from; the side it leans to is always even.
enum class AngleDistribution {
  cone,      ///< as many trials on each piece of the cap that wander reaches
  gaussian,  ///< wander is the standard deviation to each of two sides, so that the angle is Rayleigh's
  table      ///< of angles as shares of wander, as RandomTree::wander_table says
};

inline constexpr std::size_t kMostAngles = 64;   ///< of a table
inline constexpr double kMostOfWander = 1000.0;  ///< as a share

/// Greene's random walk: each tip grows by its best trial, and nodes branch when they come of age.
struct RandomTree {
  Length length{2.4};
  int branch_age_min = 1;  ///< iterations before a node branches, drawn evenly from [min, max]
  int branch_age_max = 3;
  Value branch_angle_deg = 60.0;
  Value wander_deg = 20.0;  ///< a trial's direction lies within this angle of the way that the limb was going
  std::optional<AngleDistribution> wander_distribution;  ///< as it was written; ask distribution()
  std::vector<glm::dvec2> wander_table;  ///< [share of wander, density of the angle there], straight between
  int trials_min = 150;                  ///< trials before the best one is taken
  int trials_max = 300;                  ///< trials before the tip gives up
  /// Segments that a tip lays at once: as many as find room, and none where fewer do. Where a plant's rules
  /// have more than one anywhere, limbs leave each other in no other way.
  int fork_min = 1, fork_max = 1;
  double fork_angle_deg = 30.0;  ///< at least, between any two of them
  int fork_apart = 0;            ///< tips of so many segments behind a fork lay one at most

  AngleDistribution distribution() const {
    return wander_distribution.value_or(wander_table.empty() ? AngleDistribution::cone
                                                             : AngleDistribution::table);
  }
};

/// Who chooses whom, of attractors and nodes.
enum class Acts {
  on_nearest_node,  ///< each attractor pulls the node nearest to it (Runions et al. 2007)
  /// Each node picks the attractor that is nearest to it (Tanaka et al. 2022); of those that pick the same,
  /// the nearest grows towards it, once.
  on_every_node,
  /// Each attractor pulls its relative neighbours: what comes to it from several sides meets in it (Runions
  /// et al. 2005; rules/front/front.h).
  on_all_neighbours
};

/// How limbs of colonization leave each other.
struct Branching {
  double angle_min_deg = 0.0;    ///< between a branch and its limb
  double angle_max_deg = 180.0;  ///< between a segment and the one before it, branches too
  Distance above{0.0};           ///< limbs branch from so far above (or below) their plant's start on
  int most = 1000;               ///< branches from one node
};

/// Space colonization: attractors pull what grows their way, and end where it comes near.
struct Colonization {
  std::string attractors;          ///< those of the scene that have this name
  std::optional<CrownSpec> crown;  ///< or its own, about each seed: all plants of a planting compete for them
  // Where they are not given, they follow from how far the attractors are apart (rules/front/lengths.h).
  std::optional<Distance> step;       ///< of a new node from the one that it grew from
  std::optional<Distance> influence;  ///< attractors act on nodes that are nearer than this
  std::optional<Distance> kill;       ///< attractors end when a node is nearer than this
  Acts acts = Acts::on_nearest_node;
  bool onto = false;         ///< new nodes stand on attractors
  bool repeated = false;     ///< a node is a start for each of its attractors
  double avoid_deg = 110.0;  ///< how far a way may turn aside where something stands in it
  int trials = 60;           ///< ways that are tried then
  Branching branching;
  std::vector<std::string> fields;  ///< guide fields of the scene that bend it
};

/// Where a new element is tried, seen from one that lies there already.
enum class Around {
  ring,      ///< at a distance that is drawn, on any side
  gaussian,  ///< the distance is the standard deviation to each of two sides; never more than three of them
  edges,     ///< flush with an edge of it, a gap away, pushed along until it meets a corner or a neighbour
  steps      ///< by one of some steps
};

/// Which way the +y of a new element goes along the surface, before it is turned.
enum class Ahead {
  parent,  ///< as that of the element beside which it is laid
  up       ///< up the slope
};

inline constexpr std::size_t kMostSteps = 64;

/// Diffusion: elements are laid on surfaces, each beside one that lies there already.
struct Diffusion {
  Around around = Around::ring;
  /// Between the two; of steps: how far off they land, as for gaussian. Without it 1 voxel width, of steps 0.
  std::optional<Length> distance;
  std::vector<glm::dvec2> steps;  ///< metres, along the +x and +y of the one that lies there
  Distance gap_min{0.0};          ///< between outlines of what lies flat, and the feet of what does not
  Distance gap_max{kNoLimit};     ///< to the nearest neighbour
  Ahead ahead = Ahead::parent;
  Value turn_deg = 0.0;        ///< about the surface's normal, at most, to either side by chance
  double turn_step_deg = 0.0;  ///< in whole steps of this; 0: as it comes
  Value tilt_deg = 0.0;        ///< from what its pose says, at most, to any side by chance
  double bend_deg = 60.0;      ///< between the surface's normals at the two, at most
  Distance off{0.5};           ///< corners of what lies flat are no farther off the surface
  double fill = 1.0;           ///< share of the surface that is covered when it ends
  int rounds = 1;              ///< in which all that lies there is asked, in one iteration

  Value far() const { return distance ? distance->value : Value(around == Around::steps ? 0.0 : 1.0); }
};

/// How the brightest part of the sky is found.
enum class Brightest {
  table,  ///< Greene's table of the sky, filtered with the cosine lobe
  moment  ///< the weighted sum of the directions in sight
};

/// A place or a way of the scene that trials are bent towards.
struct PullSpec {
  std::optional<sim::Vec3> point_m;    ///< either this, in world space
  std::optional<sim::Vec3> direction;  ///< or this, of any length
  Value amount = 0.0;                  ///< below 0: away from it
};
inline constexpr std::size_t kMostPulls = 8;

/// Something that is sensed around a place, by a name of its own: biases, requirements, preferences and
/// curves ask for it.
struct SenseSpec {
  enum class Measure {
    density,   ///< share of the voxels within `within` that are filled, 0..1; its way is to their centre of
               ///< mass
    distance,  ///< to the nearest, metres; `within` where none is nearer; its way is there
    nearness,  ///< of the nearest: 1 at it, 0 from `within` on; the same way
    height  ///< above the first that lies straight below, or else the world's floor, metres; its way is down
  };
  std::string name;
  Measure measure = Measure::density;
  /// Whose voxels: everything, scene, plants, own, others, or a region; or kOfLines, or kOfSurfaces.
  std::string of = "everything";
  Distance within{6.0};
};
inline constexpr std::size_t kMostSenses = 8;
/// What `of` says beside the names of regions; in the order of sim::Whose::Kind.
inline constexpr std::array kWhose{"everything", "scene", "plants", "own", "others"};

/// Its lines, and not by voxels but exactly: of their distance and nearness alone.
inline constexpr const char* kOfLines = "lines";
/// Those of its meshes, guides too, likewise.
inline constexpr const char* kOfSurfaces = "surfaces";

/// What a rule set does by a sense.
struct SenseBias {
  std::string name;
  Value amount = 0.0;  ///< along the sense's way; below 0 the other way
};
struct SenseBounds {
  std::string name;
  double min = -kNoLimit, max = kNoLimit;  ///< of what it reads
};
struct SensePreference {
  std::string name;
  double at = 0.0, weight = 1.0;  ///< a trial scores by how far the reading at its end is from `at`
};

/// Each bends a trial's direction towards a vector by its weight: 0 not at all, 1 all the way.
struct Bias {
  Value up = 0.0;
  Value gravity = 0.0;
  Value light = 0.0;  ///< towards the brightest part of the sky; below 0 away from it
  Brightest brightest = Brightest::table;
  Value away = 0.0;    ///< from the nearest scene object
  Value toward = 0.0;  ///< to the nearest scene object
  Value twist = 0.0;   ///< to one side of the plane through the last segment and the local centre of mass
  Distance twist_radius{8.0};  ///< how far the centre of mass looks
  Value apex = 0.0;            ///< to the nearest apex of a region; below 0 away from it
  std::string apex_of;         ///< which region's; empty: of that which is nearest
  std::vector<PullSpec> towards;
  std::vector<SenseBias> senses;
};

/// A trial that does not meet these is rejected.
struct Require {
  bool clear = true;  ///< intersects nothing but its own parent
  Distance proximity_min{0.0};
  Distance proximity_max{kNoLimit};
  double exposure_min = 0.0;
  double exposure_max = 1.0;
  int age_min = 0, age_max = kNoAge;  ///< iterations since growth began
  int in_region_max = kNoAge;         ///< segments of a limb, one after another, near one region
  std::vector<SenseBounds> senses;    ///< of what a tip reads
  std::vector<SenseBounds> along;     ///< of what is read at the quarters of a trial and at its end
};

/// Ranks the trials that are left: the least sum wins of how far each is from what is preferred, by weight.
struct Prefer {
  bool has_proximity = false;
  Distance proximity;   ///< mean over the segment
  double weight = 1.0;  ///< of proximity, a voxel width
  std::vector<SensePreference> senses = {};
  bool any() const { return has_proximity || !senses.empty(); }
};

struct Light {
  double sun = 0.5;  ///< weights of the blend; they are normalized to a sum of 1
  double sky = 0.5;
  double boost = 1.0;  ///< growth rate, leaf count and leaf size at full exposure over those at the minimum
};

/// How elements follow each other along a limb.
struct Phyllotaxis {
  double angle_deg = 137.5;  ///< about the stem, from one place to the next
  Distance spacing{0.5};     ///< from one place to the next
  int whorl = 1;             ///< elements at one place, evenly about the stem
  Value pitch_deg = 50.0;    ///< between an element and the way that its stem goes
};

/// What decides how an element stands.
enum class Pose {
  free,     ///< chance or phyllotaxis, and its face by Element::face
  hang,     ///< it grows straight down
  stand,    ///< straight up
  light,    ///< its face looks at the brightest part of the sky; free where none is seen
  surface,  ///< it lies flat on the scene, along its limb; free where nothing is near
  aside     ///< likewise flat, but leaving its limb by the pitch, to one side or the other
};

inline bool liesFlat(Pose pose) {
  return pose == Pose::surface || pose == Pose::aside;
}

struct Element {
  std::string name = "leaf";
  int trials = 30;
  Value per_segment = 1.0;   ///< expected number on a segment at the least exposure
  Value size = 1.0;          ///< scale of the polygons at the least exposure
  bool size_metres = false;  ///< size is what a polygon's unit measures, in metres; else a factor
  Value face = 0.7;  ///< how much the face turns from the stem's own way to the open and the sky, 0..1
  Pose pose = Pose::free;
  sim::Colour colour{0.13f, 0.30f, 0.05f};       ///< linear RGB
  std::vector<std::vector<sim::Vec3>> polygons;  ///< corners (see sim::ElementShape)
  bool polygons_metres = false;                  ///< they are in metres; else in voxel widths, or in sizes
  bool crosses = false;                          ///< others and limbs may pass through it
  std::optional<Phyllotaxis> phyllotaxis;        ///< without it they stand where chance puts them
  Length petiole{0.0};                           ///< from the stem to where the polygons' origin is
  /// What is painted on the polygons, as it is written: a kind that the program draws, or a file.
  std::string texture;
  std::shared_ptr<const sim::Picture> picture;  ///< of a file; who reads it puts it here
  std::string from;         ///< or a scene, as it is written, of which the picture is a product
  std::string product;      ///< empty: its only picture
  std::string from_here;    ///< where that scene lies; who reads it puts it here
  bool own_colour = false;  ///< likewise: beside `from` it has a colour of its own
  /// The polygons are a body's lower side, and this is how far up it goes.
  Distance thick{0.0};
  bool body = false;     ///< the polygons are all of its sides: that was done (rules/growth/voxel_widths.h)
  Value share = 1.0;     ///< diffusion: how often it is tried before the others, as a weight
  double opacity = 1.0;  ///< share of the polygons' area that the texture leaves; who reads it puts it here
  sim::ColourVariation varies;
  std::optional<Emission> emits;
  double alpha = 1.0;  ///< how much it hides of what is behind it, 0..1: in pictures alone
};

/// How a plant's ways stray from those that grew: see sim::StemForm::Rough.
struct Roughness {
  double hurst = 0.7;
  Distance amplitude{0.5};
  Distance over{10.0};
  Distance detail{0.5};
};

/// What a plant's stems are like: see sim::StemGirth and sim::StemForm.
struct Stem {
  sim::Colour colour{0.16f, 0.10f, 0.05f};  ///< linear RGB
  std::optional<sim::Colour> shoots;        ///< of what grew last, likewise; none: a little green
  Distance radius{0.08};                    ///< of a twig that does not fork
  sim::StemGirth::By by = sim::StemGirth::By::pipes;
  double exponent = 2.05;
  Distance thickens{0.02};  ///< by age: in an iteration
  Distance thickest{kNoLimit};
  double order_share = 1.0;
  std::optional<Roughness> rough;
  sim::StemForm::Forks forks = sim::StemForm::Forks::grown;
  std::string texture;                          ///< as Element::texture
  std::shared_ptr<const sim::Picture> picture;  ///< of a file; who reads it puts it here
  std::optional<StemEmission> emits;
  double alpha = 1.0;  ///< as Element::alpha
};

struct RuleSet;

/// What holds where a region of the scene is nearest.
struct RegionRule {
  bool forbidden = false;
  std::shared_ptr<const RuleSet> rules;  ///< null: the enclosing rule set
};

enum class Propagate { random_tree, colonization, diffusion };

struct RuleSet {
  std::string name = "unnamed";
  Propagate propagate = Propagate::random_tree;
  RandomTree random_tree;
  Colonization colonization;
  Diffusion diffusion;
  Bias bias;
  Require require;
  Prefer prefer;
  Light light;
  std::vector<SenseSpec> senses;
  Stem stem;
  std::vector<Element> elements;
  std::map<std::string, RegionRule, std::less<>> regions;  ///< by region name
  std::optional<RegionRule> others;                        ///< of every region that is not named
  std::shared_ptr<const RuleSet> branches;                 ///< of limbs that leave the trunk; null: this set
  std::shared_ptr<const RuleSet> twigs;      ///< of limbs that leave those, and so on; null: as branches
  std::shared_ptr<const RuleSet> otherwise;  ///< tried where this one fails (Greene's secondary set)
};

/// The sense of a name, which the rule set has.
const SenseSpec& senseNamed(const RuleSet& rules, std::string_view name);

/// What holds in a region: what its name says, or else `others`; null where the rule set says nothing of it.
/// Beyond the boundary layers no region is known, and nobody should ask.
const RegionRule* ruleFor(const RuleSet& rules, std::string_view region);

}  // namespace espalier::rules
