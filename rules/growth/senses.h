#pragma once
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "rules/language/rule_set.h"
#include "sim/grow/process.h"
#include "sim/sense/company.h"

namespace espalier::rules {

/// What a place sees of the sun and the sky: shares of all that there is, 0..1.
struct Exposure {
  double sun = 0.0, sky = 0.0;
};

/// What there is around a site: the same for every rule set.
struct Surroundings {
  sim::Vec3 at_vx{0.0};
  sim::Voxel voxel{0};
  sim::Vec3 heading{0.0};  ///< unit direction of the limb that ends here; zero at a seed
  sim::Vec3 away{0.0};     ///< unit, from the nearest scene object; zero where none is near
  /// Voxels of the limb that ends here, and the first ones of those that leave: no obstacle.
  std::vector<sim::Voxel> attachment;
};

/// Light, and growth by it.
struct Vigour {
  double exposure = 0.0;  ///< blended
  double vigour = 1.0;    ///< growth rate over that at the least exposure: 1 .. boost
};

/// What one rule set makes of them.
struct Senses {
  sim::Vec3 light{0.0};  ///< unit, towards the brightest part of the sky; zero where none is seen
  /// Unit, normal to the plane through the heading and the local centre of mass; zero without a twist, at a
  /// seed, and where nothing stands near.
  sim::Vec3 twist{0.0};
  sim::Vec3 apex{0.0};  ///< unit, to the nearest apex that `bias.apex` means; zero where there is none
  std::array<sim::Vec3, kMostPulls> towards{};  ///< unit, as `bias.towards` has them
  std::array<sim::Vec3, kMostSenses> sensed{};  ///< unit, as `bias.senses` has them
  double exposure = 0.0;                        ///< blended
  double vigour = 1.0;                          ///< growth rate over that at the least exposure: 1 .. boost
  Circumstance circumstance;                    ///< what the rule set's values may depend on
};

/// Whether a rule set turns to the brightest spot of a table of the sky: leaves alone face the moment, which
/// costs nothing.
bool readsSkyTable(const RuleSet& rules);
Exposure exposureOf(const sim::Light& light);
/// What one rule set makes of the light. To be asked before all else, which is dearer: many sites end by it.
Vigour vigourOf(const Exposure& seen, const RuleSet& rules);
Surroundings lookAround(const sim::SiteView& view, const sim::Site& site);
/// Whether a rule set, or one that it leads to, has a sense of this (SenseSpec::of).
bool hasSenseOf(const RuleSet& rules, std::string_view of);

/// Whose voxels a sense asks for.
sim::Whose whoseOf(const sim::SiteView& view, const SenseSpec& sense);
/// What a sense of the distance or nearness reads in a place where this is the nearest.
double distanceRead(std::optional<sim::Vec3> nearest_vx, sim::Vec3 at_vx, const SenseSpec& sense,
                    const sim::Frame& frame);
/// What one of a rule set's senses reads in a place inside the world.
double readingOf(const sim::SiteView& view, const SenseSpec& sense, sim::Vec3 at_vx);
/// Whether what a tip reads is what its rule set requires.
bool readsAsRequired(const RuleSet& rules, const Senses& senses);
Senses sense(const sim::SiteView& view, const Surroundings& around, const Vigour& vigour,
             const RuleSet& rules);

}  // namespace espalier::rules
