#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "sim/grow/process.h"
#include "sim/sense/intersection.h"
#include "tests/support/plain_tiling.h"

/// Two small growth processes, unlike each other, with which growth itself is tested.
namespace espalier::tests {

/// Grows segments: every tip goes on one step in a random direction, and each node has a second site that
/// tries once, three iterations later. Remembers its tips.
class Creeper : public sim::Process {
 public:
  sim::Wants wants() const override { return {}; }
  sim::Plant seedling() const override {
    sim::Plant plant;
    plant.skeleton.columns["step_vx"];
    return plant;
  }
  void begin(const sim::StandView& stand, sim::Columns& memory, sim::Commons&) const override {
    for (std::size_t i = 0; i < stand.plants.size(); ++i)
      remember(memory, {static_cast<int>(i), 0, 0, {}}, 0);
  }
  std::vector<sim::Site> due(const sim::StandView& stand, sim::Columns& memory,
                             sim::Commons&) const override {
    std::vector<sim::Site> sites;
    const auto& when = sim::column<std::int32_t>(memory, "due");
    for (std::size_t i = 0; i < when.size(); ++i) {
      if (when[i] > stand.iteration) continue;
      sim::Site site = siteAt(memory, i);
      site.at_vx = stand.plants[static_cast<std::size_t>(site.plant)]
                       .skeleton.position_vx[static_cast<std::size_t>(site.node)];
      sites.push_back(site);
    }
    std::sort(sites.begin(), sites.end(), [](const sim::Site& a, const sim::Site& b) {
      return std::tie(a.plant, a.node, a.number) < std::tie(b.plant, b.node, b.number);
    });
    return sites;
  }
  sim::Proposal propose(const sim::SiteView& view, const sim::Site& site,
                        const sim::RandomKey& key) const override {
    sim::Proposal proposal;
    sim::Slots slots(key, sim::Purpose::custom);
    const double step = 2.0 + slots.uniform(2);
    const sim::Vec3 to = site.at_vx + step * direction(slots);
    sim::ProposedSegment segment{to, {}, sim::Passage::around, {static_cast<float>(step)}};
    std::vector<sim::Voxel> passes, attachment;
    sim::tileSegment(site.at_vx, to, passes);
    for (const sim::Voxel v : passes) {
      if (sim::besides(v, sim::voxelAt(site.at_vx))) attachment.push_back(v);
    }
    const sim::Fit fit =
        sim::fit(view.world, passes, attachment, segment.passage, sim::kNoPlant, segment.takes);
    proposal.outcome = fit == sim::Fit::clear     ? sim::Outcome::grown
                       : fit == sim::Fit::blocked ? sim::Outcome::blocked
                                                  : sim::Outcome::out_of_world;
    if (!sim::contains(view.world.frame().size, sim::voxelAt(to)))
      proposal.outcome = sim::Outcome::out_of_world;
    ++proposal.trials[static_cast<std::size_t>(proposal.outcome)];
    if (view.record_attempts) proposal.attempts.push_back({site.at_vx, to, proposal.outcome, false});
    if (proposal.outcome == sim::Outcome::grown) proposal.segment = std::move(segment);
    proposal.sprouts = {{0, 1}, {1, 3}};
    return proposal;
  }
  void settle(const sim::StandView& stand, std::span<const sim::Verdict> verdicts, sim::Columns& memory,
              sim::Commons&) const override {
    sim::Columns left;
    const auto& when = sim::column<std::int32_t>(memory, "due");
    for (std::size_t i = 0; i < when.size(); ++i) {
      if (when[i] > stand.iteration) remember(left, siteAt(memory, i), when[i]);
    }
    for (const sim::Verdict& v : verdicts) {
      if (v.outcome == sim::Outcome::grown) {
        for (const sim::Sprout& s : v.proposal->sprouts)
          remember(left, {v.site.plant, v.node, s.number, {}}, stand.iteration + s.wait);
      } else if (v.site.number == 0) {
        remember(left, v.site, stand.iteration + 1);
      }
    }
    memory = std::move(left);
  }
  std::size_t alive(const sim::Columns& memory, const sim::Commons&) const override {
    return sim::column<std::int32_t>(memory, "due").size();
  }

 protected:
  virtual sim::Vec3 direction(sim::Slots& slots) const {
    return sim::inCone(sim::Vec3(0, 1, 0), -1.0, slots.uniform(0), slots.uniform(1));
  }

 private:
  static sim::Site siteAt(const sim::Columns& memory, std::size_t i) {
    return {sim::column<std::int32_t>(memory, "plant")[i],
            sim::column<std::int32_t>(memory, "node")[i],
            static_cast<std::uint32_t>(sim::column<std::int32_t>(memory, "number")[i]),
            {}};
  }
  static void remember(sim::Columns& memory, const sim::Site& site, int due) {
    sim::column<std::int32_t>(memory, "plant").push_back(site.plant);
    sim::column<std::int32_t>(memory, "node").push_back(site.node);
    sim::column<std::int32_t>(memory, "number").push_back(static_cast<std::int32_t>(site.number));
    sim::column<std::int32_t>(memory, "due").push_back(due);
  }
};

/// Places elements and no segments: square tiles two voxel widths wide, each beside one that lies already,
/// level, never two whose middles are nearer than two (exactly, not by voxels). Draws on a store that all
/// plantings of tiles share, and remembers where its tiles lie and how much it has used up.
class Tiler : public sim::Process {
 public:
  static constexpr double kSide = 2.0;
  static constexpr int kStore = 60;  // tiles, for everybody

  sim::Wants wants() const override { return {}; }
  sim::Plant seedling() const override {
    sim::Plant plant;
    plant.shapes = {{"tile", {{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}}, {}}};
    return plant;
  }
  void begin(const sim::StandView& stand, sim::Columns& memory, sim::Commons& commons) const override {
    sim::column<std::int64_t>(commons["tiles"], "left") = {kStore};
    sim::column<std::int64_t>(memory, "used") = {0};
    for (std::size_t i = 0; i < stand.plants.size(); ++i) {
      sim::column<std::int32_t>(memory, "plant").push_back(static_cast<int>(i));
      sim::column<sim::Vec3>(memory, "middle").push_back(stand.plants[i].skeleton.position_vx[0]);
    }
  }
  /// One site a side of each tile that lies; some lie beside each other, and want the same place.
  std::vector<sim::Site> due(const sim::StandView& stand, sim::Columns& memory,
                             sim::Commons&) const override {
    sim::column<std::int32_t>(memory, "asked_in") = {stand.iteration};
    std::vector<sim::Site> sites;
    std::vector<std::uint32_t> numbers(stand.plants.size(), 0);
    const auto& plants = sim::column<std::int32_t>(memory, "plant");
    const auto& middles = sim::column<sim::Vec3>(memory, "middle");
    for (std::size_t i = 0; i < plants.size(); ++i) {
      for (const sim::Vec3 way : {sim::Vec3(1, 0, 0), {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}}) {
        const sim::Vec3 at = middles[i] + kSide * way;
        if (!sim::contains(stand.world.frame().size, sim::voxelAt(at))) continue;
        const auto plant = static_cast<std::size_t>(plants[i]);
        sites.push_back({plants[i], 0, numbers[plant]++, at});
      }
    }
    std::stable_sort(sites.begin(), sites.end(),
                     [](const sim::Site& a, const sim::Site& b) { return a.plant < b.plant; });
    return sites;
  }
  sim::Proposal propose(const sim::SiteView& view, const sim::Site& site,
                        const sim::RandomKey& key) const override {
    sim::Proposal proposal;
    proposal.retire = false;
    // What due() has left in memory is there.
    if (sim::column<std::int32_t>(view.memory, "asked_in") != std::vector<std::int32_t>{view.iteration})
      return proposal;
    proposal.outcome = sim::Outcome::blocked;
    const auto& left = sim::column<std::int64_t>(view.commons.at("tiles"), "left");
    if (left[0] <= 0 || clashes(site.at_vx, sim::column<sim::Vec3>(view.memory, "middle"))) return proposal;
    sim::ProposedElement tile;
    tile.element.position_vx = site.at_vx;
    tile.element.x = {1, 0, 0}, tile.element.y = {0, 1, 0}, tile.element.z = {0, 0, 1};
    tile.element.scale = 0.9 + 0.1 * sim::Slots(key, sim::Purpose::custom).uniform(0);
    tile.coverage = 1.0f;
    tile.passage = sim::Passage::through;  // tiles share voxels where they touch
    std::vector<sim::Vec3> corners;
    for (const double x : {-1.0, 1.0}) {
      for (const double z : {-x, x}) corners.push_back(sim::placed(tile.element, {x, 0, z}));
    }
    std::vector<sim::Voxel> passes;
    tilePolygon(corners, passes);
    if (sim::fit(view.world, passes, {}, tile.passage, sim::kNoPlant, tile.takes) == sim::Fit::outside) {
      proposal.outcome = sim::Outcome::out_of_world;
      return proposal;
    }
    proposal.outcome = sim::Outcome::grown;
    proposal.elements.push_back(std::move(tile));
    return proposal;
  }
  bool agrees(const sim::Proposal& proposal, std::span<const sim::Proposal* const> accepted) const override {
    const sim::Vec3 middle = proposal.elements[0].element.position_vx;
    return std::none_of(accepted.begin(), accepted.end(), [&](const sim::Proposal* other) {
      return glm::distance(middle, other->elements[0].element.position_vx) < kSide - 1e-9;
    });
  }
  void settle(const sim::StandView&, std::span<const sim::Verdict> verdicts, sim::Columns& memory,
              sim::Commons& commons) const override {
    for (const sim::Verdict& v : verdicts) {
      if (v.outcome != sim::Outcome::grown || v.elements != 1) continue;
      sim::column<std::int32_t>(memory, "plant").push_back(v.site.plant);
      sim::column<sim::Vec3>(memory, "middle").push_back(v.site.at_vx);
      ++sim::column<std::int64_t>(memory, "used")[0];
      --sim::column<std::int64_t>(commons.at("tiles"), "left")[0];
    }
  }
  std::size_t alive(const sim::Columns& memory, const sim::Commons& commons) const override {
    if (sim::column<std::int64_t>(commons.at("tiles"), "left")[0] <= 0) return 0;
    return sim::column<sim::Vec3>(memory, "middle").size();
  }

 private:
  static bool clashes(sim::Vec3 middle, const std::vector<sim::Vec3>& others) {
    return std::any_of(others.begin(), others.end(),
                       [&](sim::Vec3 other) { return glm::distance(middle, other) < kSide - 1e-9; });
  }
};

}  // namespace espalier::tests
