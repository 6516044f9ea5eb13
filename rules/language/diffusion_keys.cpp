#include "rules/language/diffusion_keys.h"

#include <algorithm>

#include "rules/language/key_builder.h"

namespace espalier::rules {
namespace {

const char* const kInWidths = "voxel widths";
const char* const kInDegrees = "degrees";

}  // namespace

std::shared_ptr<const Table> diffusionKeys() {
  const auto gap =
      TableOf<Diffusion>()
          .distance("min", &Diffusion::gap_min,
                    {.unit = kInWidths,
                     .limits = {0.0, 1000.0},
                     .meaning = "No neighbour is nearer; of edges, what lies flush is just so far away."})
          .distance("max", &Diffusion::gap_max,
                    {.unit = kInWidths,
                     .limits = {0.0, 1000.0, true},
                     .meaning = "The nearest neighbour is no farther. Without it any distance will do."})
          .shared();
  return TableOf<Diffusion>()
      .choice<Around>("around", &Diffusion::around,
                      {{"ring", Around::ring},
                       {"gaussian", Around::gaussian},
                       {"edges", Around::edges},
                       {"steps", Around::steps}},
                      {.meaning = "Where an element is tried beside another: at a distance, about it, flush "
                                  "with its edges, or by steps."})
      .length("distance", &Diffusion::distance,
              {.unit = kInWidths,
               .limits = {0.0, 1000.0},
               .meaning = "From the one to the other; of gaussian and steps: the deviation to each of two "
                          "sides. Without it 1, of steps 0."})
      .custom(
          "steps", Kind::outline, [](Diffusion& d, const Datum& datum) { d.steps = std::get<Pairs>(datum); },
          [](const Diffusion& d) { return d.steps.empty() ? Datum{} : Datum{d.steps}; },
          {.unit = "metres",
           .limits = {-1000.0, 1000.0},
           .meaning = "From the one to the other, along the +x and +y of the one that lies there.",
           .most = kMostSteps})
      .section("gap", std::identity{}, gap,
               {.meaning = "Between the outlines of what lies flat, and the feet of what does not."}, "min")
      .choice<Ahead>(
          "ahead", &Diffusion::ahead, {{"parent", Ahead::parent}, {"up", Ahead::up}},
          {.meaning = "Which way an element's +y goes along the surface: as its neighbour's, or up "
                      "the slope."})
      .value("turn", &Diffusion::turn_deg,
             {.unit = kInDegrees,
              .limits = {0.0, 180.0},
              .meaning = "How far it turns from there about the surface's normal, at most, to either side."})
      .number("turn_step", &Diffusion::turn_step_deg,
              {.unit = kInDegrees,
               .limits = {0.0, 180.0},
               .meaning = "Turns snap to whole steps of this; 0: they do not."})
      .value("tilt", &Diffusion::tilt_deg,
             {.unit = kInDegrees,
              .limits = {0.0, 90.0},
              .meaning = "How far it leans from its pose, at most, to any side."})
      .number(
          "bend", &Diffusion::bend_deg,
          {.unit = kInDegrees,
           .limits = {0.0, 180.0},
           .meaning = "Between the surface's normals at the two, at most: it goes around no sharper edge."})
      .distance("off", &Diffusion::off,
                {.unit = kInWidths,
                 .limits = {0.0, 1000.0, true},
                 .meaning = "Corners of what lies flat are no farther off the surface."})
      .number(
          "fill", &Diffusion::fill,
          {.unit = "fraction",
           .limits = {0.0, 1.0, true},
           .meaning = "Share of the surface, where it may lie, that is covered when nothing more is laid."})
      .whole("rounds", &Diffusion::rounds,
             {.unit = "rounds",
              .limits = {1.0, 1'000'000.0},
              .meaning = "In an iteration; in each round all that lies there is asked for one more."})
      .shared();
}

void checkDiffusion(const RuleSet& rules, const Check::Given& given, const Check::Complain& complain) {
  const Diffusion& diffusion = rules.diffusion;
  const bool steps = diffusion.around == Around::steps;
  if (steps && diffusion.steps.empty())
    complain("diffusion.around", "steps that are not there; expected steps: [[ALONG X, ALONG Y], ...]");
  if (!steps && !diffusion.steps.empty() && given("diffusion.steps") > 0)
    complain("diffusion.steps", "steps beside another way around; expected around: steps, or no steps");
  if (rules.propagate != Propagate::diffusion) return;
  if (rules.elements.empty()) {
    complain("propagate", "diffusion lays elements, and there are none; expected some under elements");
    return;
  }
  const bool lies = std::any_of(rules.elements.begin(), rules.elements.end(),
                                [](const Element& element) { return element.pose == Pose::surface; });
  if (diffusion.around == Around::edges && !lies)
    complain("diffusion.around",
             "edges, and no element lies flat; expected elements with pose: surface, or another way around");
}

}  // namespace espalier::rules
