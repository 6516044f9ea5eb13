#include "rules/language/registry.h"

#include "rules/language/diffusion_keys.h"
#include "rules/language/element_keys.h"
#include "rules/language/envelope_keys.h"
#include "rules/language/front_keys.h"
#include "rules/language/key_builder.h"
#include "rules/language/sense_keys.h"
#include "rules/language/wander_keys.h"

// Greene's names are those of figure 4 and section 6 of: Ned Greene, Voxel Space Automata, SIGGRAPH 1989.
namespace espalier::rules {
namespace {

constexpr Limits kWeight{0.0, 1.0};
constexpr Limits kAngle{0.0, 180.0};
constexpr Limits kTrials{1.0, 10'000.0};  // as many as a random key tells apart
constexpr Limits kDistance{0.0, 1000.0};
const char* const kVoxels = "voxel widths";
const char* const kDegrees = "degrees";

std::shared_ptr<const Table> randomTreeKeys() {
  const auto trials = TableOf<RandomTree>()
                          .whole("min", &RandomTree::trials_min,
                                 {.unit = "trials",
                                  .limits = kTrials,
                                  .meaning = "Trials that are made before the best one is taken.",
                                  .greene = "no_of_trials_min"})
                          .whole("max", &RandomTree::trials_max,
                                 {.unit = "trials",
                                  .limits = kTrials,
                                  .meaning = "Trials after which a tip that found no place retires.",
                                  .greene = "no_of_trials_max"})
                          .shared();
  return TableOf<RandomTree>()
      .length("length", &RandomTree::length,
              {.unit = kVoxels,
               .limits = {0.0, 1000.0, true},
               .meaning = "Length of a segment.",
               .greene = "length"})
      .wholeRange("branch_age_range", &RandomTree::branch_age_min, &RandomTree::branch_age_max,
                  {.unit = "iterations",
                   .limits = {1.0, 10'000.0},
                   .meaning = "Age at which a node branches, drawn evenly for each node.",
                   .greene = "branch_age_range"})
      .value("branch_angle", &RandomTree::branch_angle_deg,
             {.unit = kDegrees,
              .limits = kAngle,
              .meaning = "Angle between a branch and the limb that it leaves.",
              .greene = "branch_angle"})
      .section(
          "wander", std::identity{}, wanderKeys(),
          {.meaning =
               "How far trials turn from the way that the limb was going; a number stands for its angle."},
          "angle")
      .section("trials", std::identity{}, trials,
               {.meaning = "How hard a tip tries to find a place for its next segment."})
      .wholeRange("fork", &RandomTree::fork_min, &RandomTree::fork_max,
                  {.unit = "segments",
                   .limits = {1.0, 8.0},
                   .meaning = "Segments that a tip lays at once; with more than 1 anywhere, nothing "
                              "branches at its side."})
      .number("fork_angle", &RandomTree::fork_angle_deg,
              {.unit = kDegrees, .limits = kAngle, .meaning = "Between any two of those, at least."})
      .whole("fork_apart", &RandomTree::fork_apart,
             {.unit = "segments",
              .limits = {0.0, 100.0},
              .meaning = "Tips of so many segments behind a fork lay one segment at most."})
      .shared();
}

std::shared_ptr<const Table> biasKeys() {
  const auto weight = [](std::string meaning, std::string greene = "") {
    return About{
        .unit = "weight", .limits = kWeight, .meaning = std::move(meaning), .greene = std::move(greene)};
  };
  const auto either = [](std::string meaning, std::string greene = "") {
    return About{
        .unit = "weight", .limits = {-1.0, 1.0}, .meaning = std::move(meaning), .greene = std::move(greene)};
  };
  const auto light =
      TableOf<Bias>()
          .value("amount", &Bias::light, either("How far it bends; below 0 away from there.", "seeksun_bias"))
          .choice<Brightest>("brightest", &Bias::brightest,
                             {{"table", Brightest::table}, {"moment", Brightest::moment}},
                             {.meaning = "table: Greene's own way, one of several openings; "
                                         "moment: the mean of what is in sight, quick."})
          .shared();
  const auto apex =
      TableOf<Bias>()
          .value("amount", &Bias::apex, either("How far it bends; below 0 away from there."))
          .text("of", &Bias::apex_of,
                {.meaning = "Of which of the scene's regions; without it, of the one that is nearest.",
                 .most = 100})
          .shared();
  auto pull =
      TableOf<PullSpec>()
          .place("point", &PullSpec::point_m,
                 {.unit = "metres",
                  .limits = {-1e6, 1e6},
                  .meaning = "A place of the scene; either this or a direction."})
          .point("direction", &PullSpec::direction,
                 {.unit = "vector", .limits = {-1e6, 1e6}, .meaning = "A way; its length is nothing."})
          .value("amount", &PullSpec::amount, either("How far it bends; below 0 away from there."))
          .shared();
  const auto twist =
      TableOf<Bias>()
          .value(
              "amount", &Bias::twist,
              {.unit = "weight",
               .limits = {-1.0, 1.0},
               .meaning = "To one side of the plane through the last segment and the local centre of mass: a "
                          "helix; below 0 to the other side."})
          .distance("radius", &Bias::twist_radius,
                    {.unit = kVoxels,
                     .limits = {0.0, 64.0, true},
                     .meaning = "How far around a tip the centre of mass is taken."})
          .shared();
  return TableOf<Bias>()
      .value("up", &Bias::up, weight("Straight up.", "vertical_bias"))
      .value("gravity", &Bias::gravity, weight("Straight down."))
      .section(
          "light", std::identity{}, light,
          {.meaning = "To the brightest part of the sky that the tip sees; a number stands for its amount."},
          "amount")
      .value("away", &Bias::away, weight("From the nearest scene object."))
      .value("toward", &Bias::toward, weight("To the nearest scene object."))
      .section("twist", std::identity{}, twist,
               {.meaning = "Winds limbs around what stands near; a number stands for its amount."}, "amount")
      .section(
          "apex", std::identity{}, apex,
          {.meaning = "To the nearest of a region's highest points, as of arches; a number stands for its "
                      "amount."},
          "amount")
      .list<PullSpec>("towards", Kind::entries, &Bias::towards, pull,
                      {.meaning = "To places and along ways of the scene; a list replaces that of the base.",
                       .most = kMostPulls})
      .list<SenseBias>(
          "senses", Kind::named, &Bias::senses, senseBiasKeys(),
          {.meaning = "To or from what the rule set's senses find; a number stands for its amount.",
           .most = kMostSenses},
          "amount")
      .shared();
}

std::shared_ptr<const Table> requireKeys() {
  const auto proximity =
      TableOf<Require>()
          .distance("min", &Require::proximity_min,
                    {.unit = kVoxels,
                     .limits = kDistance,
                     .meaning = "Least mean distance of a segment from the nearest scene object."})
          .distance("max", &Require::proximity_max,
                    {.unit = kVoxels,
                     .limits = {0.0, 1000.0, true},
                     .meaning = "Greatest mean distance. Without it a plant may go where it likes.",
                     .greene = "maxprox"})
          .shared();
  const auto exposure = TableOf<Require>()
                            .number("min", &Require::exposure_min,
                                    {.unit = "fraction",
                                     .limits = kWeight,
                                     .meaning = "A tip in less light than this becomes inactive.",
                                     .greene = "exposure min"})
                            .number("max", &Require::exposure_max,
                                    {.unit = "fraction",
                                     .limits = kWeight,
                                     .meaning = "A tip in more light than this becomes inactive.",
                                     .greene = "exposure max"})
                            .shared();
  const auto age =
      TableOf<Require>()
          .whole("min", &Require::age_min,
                 {.unit = "iterations",
                  .limits = {0.0, kNoAge},
                  .meaning = "Nothing grows by this set in earlier iterations."})
          .whole("max", &Require::age_max,
                 {.unit = "iterations", .limits = {0.0, kNoAge}, .meaning = "Nor in later ones."})
          .shared();
  const auto in_region =
      TableOf<Require>()
          .whole("max", &Require::in_region_max,
                 {.unit = "segments",
                  .limits = {1.0, kNoAge},
                  .meaning = "A limb ends after so many segments, one after another, near one region."})
          .shared();
  return TableOf<Require>()
      .flag("clear", &Require::clear,
            {.meaning = "A segment intersects nothing but the limb from which it grows."})
      .section("proximity", std::identity{}, proximity,
               {.meaning = "How near to the scene a segment must stay."})
      .section("exposure", std::identity{}, exposure,
               {.meaning = "How much light a tip needs, as blended by light.blend."})
      .section("age", std::identity{}, age,
               {.meaning = "When a tip grows, counted from the first iteration."})
      .section("in_region", std::identity{}, in_region,
               {.meaning = "How long a limb stays near one region of the scene."})
      .list<SenseBounds>("senses", Kind::named, &Require::senses, senseBoundsKeys(),
                         {.meaning = "What a tip must read by the rule set's senses.", .most = kMostSenses})
      .list<SenseBounds>("along", Kind::named, &Require::along, senseBoundsKeys(),
                         {.meaning = "What they must read along a segment: at its quarters and its end.",
                          .most = kMostSenses})
      .shared();
}

std::shared_ptr<const Table> preferKeys() {
  return TableOf<Prefer>()
      .custom(
          "proximity", Kind::distance,
          [](Prefer& p, const Datum& d) {
            p.has_proximity = true;
            p.proximity = std::get<Distance>(d);
          },
          [](const Prefer& p) { return p.has_proximity ? Datum{p.proximity} : Datum{}; },
          {.unit = kVoxels,
           .limits = kDistance,
           .meaning = "The trial whose mean distance from the scene is nearest to this wins; without it the "
                      "first that is good does.",
           .greene = "seekprox"})
      .number("weight", &Prefer::weight,
              {.unit = "weight",
               .limits = {0.0, 1e6, true},
               .meaning = "What a voxel width off from proximity counts, beside what senses prefer."})
      .list<SensePreference>(
          "senses", Kind::named, &Prefer::senses, sensePreferenceKeys(),
          {.meaning = "What the rule set's senses should read at a trial's end; a number stands for at.",
           .most = kMostSenses},
          "at")
      .shared();
}

std::shared_ptr<const Table> lightKeys() {
  const auto blend =
      TableOf<Light>()
          .number("sun", &Light::sun,
                  {.unit = "weight",
                   .limits = kWeight,
                   .meaning = "Weight of sun_exposure; the two weights are made to add up to 1.",
                   .greene = "blend sun="})
          .number("sky", &Light::sky,
                  {.unit = "weight",
                   .limits = kWeight,
                   .meaning = "Weight of sky_exposure.",
                   .greene = "blend sky="})
          .shared();
  return TableOf<Light>()
      .section("blend", std::identity{}, blend, {.meaning = "What exposure is made of."})
      .number("boost", &Light::boost,
              {.unit = "factor",
               .limits = {0.1, 10.0},
               .meaning = "Growth rate, number of elements and their size at full exposure, over those at "
                          "require.exposure.min.",
               .greene = "boost"})
      .shared();
}

Table makeTable() {
  return TableOf<RuleSet>()
      .header(
          {.meaning = "The kind of this file and, if wanted, the version of the language: rules or rules/1."})
      .text("name", &RuleSet::name, {.meaning = "A name for people."})
      .base({.meaning = "A rule file to build on, or one of the library by its name: what it says holds "
                        "wherever this file is silent."})
      .choice<Propagate>("propagate", &RuleSet::propagate,
                         {{"random_tree", Propagate::random_tree},
                          {"colonization", Propagate::colonization},
                          {"diffusion", Propagate::diffusion}},
                         {.meaning = "The process that grows the plant."})
      .section("random_tree", &RuleSet::random_tree, randomTreeKeys(),
               {.meaning = "Each tip walks at random, and nodes branch when they come of age."})
      .section("colonization", &RuleSet::colonization, colonizationKeys(),
               {.meaning = "Space colonization: attractors pull nodes, and end where one comes near."})
      .section("diffusion", &RuleSet::diffusion, diffusionKeys(),
               {.meaning = "Elements are laid on surfaces, each beside one that lies there already."})
      .section("bias", &RuleSet::bias, biasKeys(),
               {.meaning = "Bends every trial: 0 not at all, 1 all the way."})
      .section("require", &RuleSet::require, requireKeys(),
               {.meaning = "Rejects the trials that do not meet these."})
      .section("prefer", &RuleSet::prefer, preferKeys(), {.meaning = "Ranks the trials that are left."})
      .section("light", &RuleSet::light, lightKeys(), {.meaning = "What light is, and what it does."})
      .list<SenseSpec>(
          "senses", Kind::named, &RuleSet::senses, senseKeys(),
          {.meaning = "What is sensed around a place, by names of your own: bias, require, prefer "
                      "and curves ask for it.",
           .most = kMostSenses})
      .section("stem", &RuleSet::stem, stemKeys(),
               {.meaning =
                    "What all of a plant's stems are like; sets of regions and otherwise have no say in it."})
      .list<Element>(
          "elements", Kind::entries, &RuleSet::elements, elementKeys(),
          {.meaning =
               "Geometry that is placed on new segments, such as leaves; a list replaces that of the base.",
           .most = 64})
      .custom(
          "branches", Kind::rules,
          [](RuleSet& r, const Datum& d) { r.branches = std::get<RuleReference>(d).rules; },
          [](const RuleSet& r) {
            return r.branches ? Datum{RuleReference{{}, r.branches}} : Datum{};
          },
          {.meaning =
               "The rule set of limbs that leave the first one, the trunk; keys written in place change "
               "this rule set."})
      .custom(
          "twigs", Kind::rules,
          [](RuleSet& r, const Datum& d) { r.twigs = std::get<RuleReference>(d).rules; },
          [](const RuleSet& r) {
            return r.twigs ? Datum{RuleReference{{}, r.twigs}} : Datum{};
          },
          {.meaning = "The rule set of limbs that leave branches, and of all beyond; keys written in place "
                      "change that of branches."})
      .custom(
          "otherwise", Kind::rules,
          [](RuleSet& r, const Datum& d) { r.otherwise = std::get<RuleReference>(d).rules; },
          [](const RuleSet& r) {
            return r.otherwise ? Datum{RuleReference{{}, r.otherwise}} : Datum{};
          },
          {.meaning = "The rule set that a tip tries where this one fails; keys written in place change this "
                      "rule set."})
      .regions({.meaning =
                    "Where a region of the scene is nearest: forbid, a file, or keys that differ; others is "
                    "each that is not named.",
                .most = 256})
      .table();
}

}  // namespace

const Table& ruleTable() {
  static const Table table = makeTable();
  return table;
}

void finish(RuleSet& rules) {
  const double sum = rules.light.sun + rules.light.sky;
  if (sum <= 0.0) return;
  rules.light.sun /= sum;
  rules.light.sky /= sum;
}

}  // namespace espalier::rules
