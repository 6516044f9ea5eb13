#include "sim/light/interreflection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/light/evened.h"
#include "sim/light/givers.h"
#include "sim/light/met.h"
#include "sim/light/sky_shares.h"
#include "sim/sweep/sweep.h"

namespace espalier::sim {
namespace {

/// The same sky below the horizon.
Sky mirrored(Sky sky) {
  for (LatticeDirection& d : sky.directions) d = {-d.v, crossedVoxels(-d.v), d.weight};
  return sky;
}

/// What a direction gives to a receiver, as surfaceSky weighs it.
Givers giversOf(const DirectionSet& directions, bool lambert) {
  std::vector<Givers::Amount> amounts;
  for (const LatticeDirection& d : directions) {
    const Vec3f unit(glm::normalize(Vec3(d.v)));
    const auto share = static_cast<float>(shareOf(d));
    amounts.push_back(lambert ? Givers::Amount{0.0f, share * unit.x, share * unit.y, share * unit.z}
                              : Givers::Amount{share, 0.0f, 0.0f, 0.0f});
  }
  return {directions, amounts, Givers::Along::nothing};
}

/// How often what is brought is evened: few directions meet what is small and bright, so that it errs more
/// than a sky does, and there is nothing in it with an edge.
constexpr int kEvenings = 4;

/// Radiosities in whole numbers, with a 1 behind them; the last is of what is not there, all zeros.
using Whole = std::array<std::uint32_t, 4>;
using Sums = std::array<std::uint64_t, 4>;

}  // namespace

class Interreflection::Seen {
 public:
  Seen(const World& world, const Lighting& light, const BounceSettings& settings)
      : settings_(settings),
        surfaces_(light.surfaces.size()),
        pairs_(light.surfaces, *light.where),
        sensors_(sensorsOf(world, light)),
        viewpoints_(viewpoints(sensors_)),
        stops_(receiversMet(world, light)) {
    Sky up = makeSky({settings.lambert ? Weighting::cosine : Weighting::uniform, 0.005, settings.directions});
    const Sky down = mirrored(up);
    standard_error_ = up.standard_error;
    const OpenTable open = sweepOpen(world.opaque(), up.directions, sensors_.places);
    sky_ = seen(open, up);
    const OpenTable open_below = sweepOpen(world.opaque(), down.directions, sensors_.places);
    below_ = seen(open_below, down);
    covered_.resize(sky_.size());
    for (std::size_t i = 0; i < sky_.size(); ++i)
      covered_[i] = sensors_.of(i).empty() ? 0.0f : std::clamp(1.0f - sky_[i] - below_[i], 0.0f, 1.0f);
    directions_ = up.directions;
    directions_.insert(directions_.end(), down.directions.begin(), down.directions.end());
    if (!settings.overcast) return;
    up.weighting = Weighting::cie_overcast;
    sky_ = seen(open, up);
  }

  const std::vector<float>& sky() const { return sky_; }
  const std::vector<float>& below() const { return below_; }
  const std::vector<float>& covered() const { return covered_; }
  const BounceSettings& settings() const { return settings_; }

  /// What each receiver gets of these radiosities.
  std::vector<Colour> pass(const std::vector<Colour>& radiosities);
  /// Over neighbouring surfaces: directions meet the edges of what is lit by chance.
  void evenOut(std::vector<Colour>& brought) const;

 private:
  /// Evens values of receivers over neighbouring surfaces.
  void even(double standard_error, std::vector<float>& values) const {
    std::ranges::copy(pairs_.evened(std::span(values).first(surfaces_), standard_error), values.begin());
  }
  /// What receivers see of a sky, as Lighting has it.
  std::vector<float> seen(const OpenTable& open, const Sky& sky) const {
    std::vector<float> seen = surfaceSky(sensors_, open, sky);
    even(sky.standard_error, seen);
    return seen;
  }
  void add(const Met& met, std::size_t first, std::size_t count, const std::vector<Whole>& whole,
           std::vector<Sums>& sums) const;

  const BounceSettings settings_;
  std::size_t surfaces_;  // among the receivers: the first
  SurfacePairs pairs_;
  double standard_error_ = 0.0;  // of a share of the half-space
  SurfaceSensors sensors_;
  std::vector<Voxel> viewpoints_;
  Stops<std::uint32_t> stops_;
  DirectionSet directions_;
  std::vector<float> sky_, below_, covered_;
  Met kept_;  // of all directions, if there is room for it
};

void Interreflection::Seen::add(const Met& met, std::size_t first, std::size_t count,
                                const std::vector<Whole>& whole, std::vector<Sums>& sums) const {
  const Givers givers = giversOf(directions_, settings_.lambert);
  constexpr std::size_t kGrain = 2048;
  parallelFor(sums.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> amounts(64 * givers.words());
    struct Given {
      std::uint32_t direction, amount;
    };
    std::vector<Given> given;  // by what lies before a receiver
    Vec3f normal(0.0f);        // no receiver's
    for (std::size_t i = begin; i < end; ++i) {
      if (const Vec3f own = sensors_.surfaces[i].surface.normal; own != normal) {
        normal = own;
        givers.give(normal, amounts.data());
        given.clear();
        for (std::uint32_t d = 0; d < count; ++d) {
          if (amounts[first + d] != 0) given.push_back({d, amounts[first + d]});
        }
      }
      const std::uint32_t* const numbers = met.by(i);
      Sums sum = sums[i];
      for (const Given& g : given) {
        const Whole& sent = whole[numbers[g.direction]];
        for (std::size_t c = 0; c < 4; ++c) sum[c] += std::uint64_t{g.amount} * sent[c];
      }
      sums[i] = sum;
    }
  });
}

std::vector<Colour> Interreflection::Seen::pass(const std::vector<Colour>& radiosities) {
  const std::size_t count = radiosities.size();
  float most = 0.0f;
  for (const Colour& c : radiosities) most = std::max({most, c.r, c.g, c.b});
  std::vector<Colour> brought(count, Colour(0.0f));
  if (most <= 0.0f) return brought;
  // Amounts add up to less than 2^30, and as many numbers below 2^31 times those to less than 2^61.
  const double unit = std::ldexp(1.0, std::ilogb(most) + 1 - 31);
  std::vector<Whole> whole(count + 1);
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < 3; ++c)
      whole[i][static_cast<std::size_t>(c)] =
          static_cast<std::uint32_t>(std::lround(radiosities[i][c] / unit));
    whole[i][3] = 1;
  }
  std::vector<Sums> sums(count);
  const std::size_t at_once = std::clamp<std::size_t>(
      settings_.most_bytes / (sizeof(std::uint32_t) * std::max<std::size_t>(count, 1)), 1,
      directions_.size());
  for (std::size_t first = 0; first < directions_.size(); first += at_once) {
    const std::size_t some = std::min(at_once, directions_.size() - first);
    const bool all = some == directions_.size();
    if (all && !kept_.numbers.empty()) {
      add(kept_, first, some, whole, sums);
      continue;
    }
    Met met = meet(stops_, sensors_, viewpoints_, directions_, first, some);
    add(met, first, some, whole, sums);
    if (all) kept_ = std::move(met);
  }
  parallelFor(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (sums[i][3] == 0) continue;
      const auto all = static_cast<double>(sums[i][3]);
      for (int c = 0; c < 3; ++c) {
        const auto sum = static_cast<double>(sums[i][static_cast<std::size_t>(c)]);
        brought[i][c] = covered_[i] * static_cast<float>(sum / all * unit);
      }
    }
  });
  return brought;
}

void Interreflection::Seen::evenOut(std::vector<Colour>& brought) const {
  float most = 0.0f;
  for (const Colour& c : brought) most = std::max({most, c.r, c.g, c.b});
  if (most <= 0.0f) return;
  std::vector<float> shares(brought.size());
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = brought[i][c] / most;
    for (int round = 0; round < kEvenings; ++round) even(standard_error_, shares);
    for (std::size_t i = 0; i < shares.size(); ++i) brought[i][c] = std::max(0.0f, shares[i]) * most;
  }
}

namespace {

const BounceSettings& checked(const BounceSettings& settings) {
  if (settings.directions < 1 || settings.directions > kMostSkyDirections) {
    throw InputError(fmt::format("interreflection by {} directions; expected 1 to {}", settings.directions,
                                 kMostSkyDirections));
  }
  if (settings.passes < 1 || settings.passes > kMostPasses)
    throw InputError(fmt::format("{} passes of light; expected 1 to {}", settings.passes, kMostPasses));
  if (!(settings.tolerance >= 0.0))
    throw InputError(fmt::format("a tolerance of {:g}; expected at least 0", settings.tolerance));
  return settings;
}

void check(const BounceSources& sources, std::size_t receivers) {
  const bool emitted = !sources.emitted.empty();
  if (sources.sun.size() != receivers || sources.albedo.size() != receivers ||
      (emitted && sources.emitted.size() != receivers))
    throw BrokenContract("light sources of another number of receivers");
  const auto within = [](const Colour& c, float most) {
    return c.r >= 0.0f && c.g >= 0.0f && c.b >= 0.0f && c.r <= most && c.g <= most && c.b <= most;
  };
  constexpr float kAnything = 1e30f;
  const auto allWithin = [&](const std::vector<Colour>& colours, float most) {
    return std::all_of(colours.begin(), colours.end(), [&](const Colour& c) { return within(c, most); });
  };
  if (!allWithin(sources.albedo, 1.0f))
    throw InputError("a surface reflects more light than falls onto it; expected colours of 0 to 1");
  if (!within(sources.sky, kAnything) || !within(sources.below, kAnything) ||
      !allWithin(sources.sun, kAnything) || !allWithin(sources.emitted, kAnything))
    throw InputError("light below 0 or without end; expected 0 or more");
}

}  // namespace

Interreflection::Interreflection(const World& world, const Lighting& light, const BounceSettings& settings)
    : seen_(std::make_unique<Seen>(world, light, checked(settings))) {}
Interreflection::~Interreflection() = default;

Bounced Interreflection::of(const BounceSources& sources) {
  Seen& passes = *seen_;
  const BounceSettings& settings = passes.settings();
  const std::size_t count = passes.sky().size();
  check(sources, count);
  Bounced bounced{passes.sky(), passes.below(), passes.covered(), std::vector<Colour>(count, Colour(0.0f)), 1,
                  0.0};
  std::vector<Colour> sent(count);
  const auto send = [&] {
    double change = 0.0, most = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const Colour now = radiosity(sources, bounced, i), off = glm::abs(now - sent[i]);
      change = std::max<double>(change, std::max({off.r, off.g, off.b}));
      most = std::max<double>(most, std::max({now.r, now.g, now.b}));
      sent[i] = now;
    }
    bounced.change = most > 0.0 ? change / most : 0.0;
  };
  send();
  while (bounced.passes < settings.passes && bounced.change > settings.tolerance) {
    bounced.light = passes.pass(sent);
    ++bounced.passes;
    send();
  }
  passes.evenOut(bounced.light);
  return bounced;
}

}  // namespace espalier::sim
