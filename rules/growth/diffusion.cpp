#include "rules/growth/diffusion.h"

#include "rules/growth/book_site.h"
#include "rules/growth/laying_front.h"
#include "rules/growth/laying_site.h"
#include "rules/growth/surface_points.h"
#include "sim/base/error.h"
#include "sim/grow/plant.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

constexpr double kFootReach_vx = 1.0;  // as far as an element's foot may be from its surface

// How much is yet to be covered, where a fill is asked for; and by how many points that is measured.
constexpr const char* kWanted = "wanted_vx2";
constexpr double kFillPoints = 65'536.0;

class DiffusionProcess final : public sim::Process {
 public:
  DiffusionProcess(RuleBook book, std::shared_ptr<const sim::SceneSurface> surface, sim::Voxel world_size)
      : book_(std::move(book)),
        wants_(wantsOf(book_)),
        kinds_(laidKinds(book_)),
        ground_(
            std::move(surface),
            [&](const std::string& region) { return setNear(book_.top(), region) != nullptr; },
            widestBend(book_), world_size),
        apart_vx_(2.0 * mostReach(book_, kinds_)) {}

  sim::Wants wants() const override { return wants_; }
  sim::Plant seedling() const override { return seedlingOf(book_); }

  void begin(const sim::StandView& stand, sim::Columns& memory, sim::Commons&) const override {
    beginLaying(stand, memory);
    // Asked for once: it looks all over the scene.
    if (fill() == 1.0) return;
    std::vector<Stance> begins;
    for (const sim::Plant& plant : stand.plants) {
      if (const auto stance = stanceAt(plant, {})) begins.push_back(*stance);
    }
    const SurfacePoints points = pointsAround(begins, ground_.surface(), book_, stand.world, kFillPoints);
    keep(points, memory);
    sim::column<double>(memory, kWanted) = {fill() * points.area()};
  }
  std::vector<sim::Site> due(const sim::StandView& stand, sim::Columns& memory,
                             sim::Commons&) const override {
    return dueOfLaying(stand, memory, apart_vx_,
                       [&](const sim::Site& site) { return lightPlace(stand, site); });
  }
  void settle(const sim::StandView& stand, std::span<const sim::Verdict> verdicts, sim::Columns& memory,
              sim::Commons&) const override {
    settleLaying(verdicts, memory);
    if (fill() == 1.0) return;
    double& wanted = sim::column<double>(memory, kWanted).front();
    for (const sim::Verdict& verdict : verdicts) {
      const auto& elements = stand.plants[static_cast<std::size_t>(verdict.site.plant)].elements;
      for (std::size_t i = 0; i < verdict.elements; ++i) {
        const sim::PlacedElement& element = elements[verdict.first_element + i];
        wanted -= coverKept(element, kinds_[static_cast<std::size_t>(element.shape)],
                            book_.top().diffusion.off.number, memory);
      }
    }
    if (wanted <= 0.0) endLaying(memory);
  }
  bool goesOn(const sim::StandView&, const sim::Columns& memory) const override {
    return layingGoesOn(memory, book_.top().diffusion.rounds);
  }
  std::size_t alive(const sim::Columns& memory, const sim::Commons&) const override {
    return countLaying(memory);
  }

  sim::Proposal propose(const sim::SiteView& view, const sim::Site& site,
                        const sim::RandomKey& given) const override {
    sim::RandomKey key = given;
    key.iteration = roundOf(view.memory) % sim::Slots::kNumbers;  // an iteration may have many rounds
    LayingSite laying;
    laying.ground = &ground_;
    laying.kinds = &kinds_;
    if (site.number != kSeedSite) {
      laying.beside = &view.plant.elements.at(elementOf(site.number));
      laying.beside_kind = &kinds_[static_cast<std::size_t>(laying.beside->shape)];
    }
    const auto stance = stanceAt(view.plant, site);
    const std::string* const region = stance ? ground_.regionAt(stance->at_vx, kFootReach_vx) : nullptr;
    if (region == nullptr) return {.outcome = Outcome::too_far};
    laying.stance = *stance;
    sim::Proposal proposal = proposeBySets(view, site, key, book_, setNear(book_.top(), *region),
                                           [&](const RuleSet& rules, const Surroundings& around,
                                               const Senses& senses, unsigned set, sim::Proposal& counts) {
                                             static_cast<void>(set);
                                             auto laid = layElement(view, laying, rules, around, senses,
                                                                    book_.firstShape(rules), key, counts);
                                             if (laid) counts.elements.push_back(std::move(*laid));
                                             return laid.has_value();
                                           });
    proposal.retire = proposal.outcome != Outcome::resting;
    return proposal;
  }

 private:
  double fill() const { return book_.top().diffusion.fill; }

  /// The surface at a site.
  std::optional<Stance> stanceAt(const sim::Plant& plant, const sim::Site& site) const {
    if (site.number == kSeedSite) return ground_.nearest(plant.skeleton.position_vx.front(), kSeedReach_vx);
    const sim::PlacedElement& element = plant.elements.at(elementOf(site.number));
    const LaidKind& kind = kinds_[static_cast<std::size_t>(element.shape)];
    const Stance stance = stanceOf(element, kind.rule->pose);
    if (kind.flat) return stance;
    constexpr double kOutside_vx = 0.3;
    const auto there = ground_.nearest(stance.at_vx + kOutside_vx * stance.normal, kFootReach_vx);
    if (!there) return std::nullopt;
    return facing(*there, stance.y);
  }

  /// Just above the surface, in the open.
  sim::Vec3 lightPlace(const sim::StandView& stand, const sim::Site& site) const {
    const sim::Plant& plant = stand.plants[static_cast<std::size_t>(site.plant)];
    const sim::Vec3 seed = plant.skeleton.position_vx.front();
    if (site.number == kSeedSite) return seed;
    const auto stance = stanceAt(plant, site);
    const sim::Vec3 at = stance ? openPlace(stance->at_vx, stance->normal)
                                : plant.elements[elementOf(site.number)].position_vx;
    constexpr double kRim_vx = 0.49;
    return glm::clamp(at, sim::Vec3(-kRim_vx), sim::Vec3(stand.world.frame().size - 1) + kRim_vx);
  }

  RuleBook book_;
  sim::Wants wants_;
  std::vector<LaidKind> kinds_;
  Ground ground_;
  double apart_vx_;
};

}  // namespace

std::shared_ptr<const sim::Process> makeDiffusion(RuleBook book,
                                                  std::shared_ptr<const sim::SceneSurface> surface,
                                                  sim::Voxel world_size) {
  return std::make_shared<DiffusionProcess>(std::move(book), std::move(surface), world_size);
}

}  // namespace espalier::rules
