#include "rules/language/front_keys.h"

#include "rules/language/envelope_keys.h"
#include "rules/language/key_builder.h"

namespace espalier::rules {
namespace {

constexpr Limits kFrontAngle{0.0, 180.0};
constexpr Limits kFrontTrials{1.0, 10'000.0};  // as many as a random key tells apart
const char* const kFrontVoxels = "voxel widths";
const char* const kFrontDegrees = "degrees";

std::shared_ptr<const Table> branchingKeys() {
  const auto angle =
      TableOf<Branching>()
          .number("min", &Branching::angle_min_deg,
                  {.unit = kFrontDegrees,
                   .limits = kFrontAngle,
                   .meaning = "Least angle between a branch and its limb."})
          .number("max", &Branching::angle_max_deg,
                  {.unit = kFrontDegrees,
                   .limits = {0.0, 180.0, true},
                   .meaning = "Greatest angle between a segment and the one before it, of branches too."})
          .shared();
  return TableOf<Branching>()
      .section("angle", std::identity{}, angle, {.meaning = "Between segments that follow each other."})
      .distance("above", &Branching::above,
                {.unit = kFrontVoxels,
                 .limits = {0.0, 1e6},
                 .meaning = "Nothing branches nearer to the height of the plant's start than this."})
      .whole("most", &Branching::most,
             {.unit = "branches", .limits = {0.0, 1000.0}, .meaning = "Most branches from one node."})
      .shared();
}

}  // namespace

std::shared_ptr<const Table> colonizationKeys() {
  const auto derived = [](std::string meaning) {
    return About{
        .unit = kFrontVoxels,
        .limits = {0.0, 1e6, true},
        .meaning = std::move(meaning) + " Without it, it follows from how far the attractors are apart."};
  };
  return TableOf<Colonization>()
      .text("attractors", &Colonization::attractors,
            {.meaning = "Which of the scene's attractors it grows to; plants that name the same compete.",
             .most = 100})
      .section("crown", &Colonization::crown, crownKeys(),
               {.meaning = "Or attractors of its own, strewn in a solid over each seed; those who grow from "
                           "one entry of plants compete for them."})
      .distance("step", &Colonization::step, derived("How far a new node stands from the one it grew from."))
      .distance("influence", &Colonization::influence,
                derived("An attractor acts on nodes that are nearer than this."))
      .distance("kill", &Colonization::kill, derived("An attractor ends when a node comes nearer than this."))
      .choice<Acts>(
          "acts", &Colonization::acts,
          {{"on_nearest_node", Acts::on_nearest_node},
           {"on_every_node", Acts::on_every_node},
           {"on_all_neighbours", Acts::on_all_neighbours}},
          {.meaning = "Each attractor pulls its nearest node, or all around it, which meet; or each "
                      "node picks its nearest attractor."})
      .flag("onto", &Colonization::onto,
            {.meaning = "New nodes stand on attractors, which are used up, in place of a step farther."})
      .flag("repeated", &Colonization::repeated,
            {.meaning = "A node grows towards each attractor that acts on it, in place of once towards all."})
      .number("avoid", &Colonization::avoid_deg,
              {.unit = kFrontDegrees,
               .limits = kFrontAngle,
               .meaning = "How far a way turns aside, at most, where something stands in it."})
      .whole(
          "trials", &Colonization::trials,
          {.unit = "trials", .limits = kFrontTrials, .meaning = "Ways that are tried then, wider and wider."})
      .section("branching", &Colonization::branching, branchingKeys(),
               {.meaning = "Where limbs leave each other, and at which angles."})
      .names("fields", &Colonization::fields,
             {.meaning = "Guide fields of the scene that bend its ways, by name.", .most = 16})
      .shared();
}

}  // namespace espalier::rules
