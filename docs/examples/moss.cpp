#include "docs/examples/moss.h"

#include "sim/sense/proximity.h"

namespace espalier::examples {
namespace {

using namespace sim;

constexpr std::int32_t kTries = 25;    // iterations in which a cushion looks for a place beside it
constexpr std::size_t kMost = Slots::kNumbers;  // sites that one node can have

class Moss final : public Process {
 public:
  explicit Moss(double most_sky) : most_sky_(most_sky) {}

  Wants wants() const override { return {.light = true}; }
  Plant seedling() const override {
    Plant plant;
    plant.shapes = {{"cushion", {{}}, {0.09f, 0.17f, 0.03f}}};
    for (int i = 0; i < 8; ++i) plant.shapes[0].polygons[0].emplace_back(unitCircle(i / 8.0), 0.0);
    return plant;
  }
  /// Tries left: of a plant's seed, then of each of its cushions.
  void begin(const StandView& stand, Columns& memory, Commons&) const override {
    for (std::size_t i = 0; i < stand.plants.size(); ++i) triesOf(memory, i) = {kTries};
  }
  std::vector<Site> due(const StandView& stand, Columns& memory, Commons&) const override {
    std::vector<Site> sites;
    for (std::size_t i = 0; i < stand.plants.size(); ++i) {
      const Plant& plant = stand.plants[i];
      const std::vector<std::int32_t>& tries = triesOf(memory, i);
      for (std::size_t k = 0; k < tries.size(); ++k) {
        const Vec3 at = k == 0 ? plant.skeleton.position_vx[0] : plant.elements[k - 1].position_vx;
        if (tries[k] > 0) sites.push_back({static_cast<int>(i), 0, static_cast<std::uint32_t>(k), at});
      }
    }
    return sites;
  }
  Proposal propose(const SiteView& view, const Site& site, const RandomKey& key) const override {
    Proposal proposal;
    ProposedElement cushion;
    proposal.outcome = lay(cushion, view, site, key);
    if (proposal.outcome == Outcome::grown) proposal.elements = {cushion};
    return proposal;
  }
  void settle(const StandView&, std::span<const Verdict> verdicts, Columns& memory, Commons&) const override {
    for (const Verdict& verdict : verdicts) {
      std::vector<std::int32_t>& tries = triesOf(memory, static_cast<std::size_t>(verdict.site.plant));
      --tries[verdict.site.number];
      if (verdict.outcome == Outcome::grown) tries.push_back(tries.size() < kMost ? kTries : 0);
    }
  }
  std::size_t alive(const Columns& memory, const Commons&) const override {
    std::size_t sites = 0;
    for (const auto& [name, tries] : memory) {
      for (const std::int32_t left : std::get<std::vector<std::int32_t>>(tries)) sites += left > 0;
    }
    return sites;
  }

 private:
  /// Throws a cushion to a place beside the site's. It stays where it lies on something, in a free voxel.
  Outcome lay(ProposedElement& cushion, const SiteView& view, const Site& site, const RandomKey& key) const {
    if (view.light->sky.fraction() > most_sky_) return Outcome::too_bright;
    Slots slots(key, Purpose::custom);  // 0 and 1: which way; 2: how large
    PlacedElement& e = cushion.element;
    e.position_vx = site.at_vx + 1.5 * inCone({0, 1, 0}, -1.0, slots.uniform(0), slots.uniform(1));
    e.scale = 0.7 + 0.5 * slots.uniform(2);
    const Voxel at = voxelAt(e.position_vx);
    const auto near = view.world.nearnessAt(at);
    e.z = awayFromScene(view.world, at);  // its face
    if (!near || near->layer > 1 || e.z == Vec3(0.0)) return Outcome::too_far;
    e.x = perpendicular(e.z);
    e.y = glm::cross(e.z, e.x);
    cushion.coverage = 1.0f;
    const Fit fits = fit(view.world, {&at, 1}, {}, Passage::around, kNoPlant, cushion.takes);
    return fits == Fit::clear ? Outcome::grown : Outcome::blocked;
  }
  static std::vector<std::int32_t>& triesOf(Columns& memory, std::size_t plant) {
    return column<std::int32_t>(memory, "tries of " + std::to_string(plant));
  }

  double most_sky_;
};

}  // namespace

std::shared_ptr<const sim::Process> makeMoss(double most_sky) {
  return std::make_shared<Moss>(most_sky);
}

}  // namespace espalier::examples
