#pragma once
#include <span>
#include <string>

#include "rules/growth/senses.h"
#include "rules/language/rule_set.h"
#include "sim/sense/peaks.h"

/// The apices of regions: what a rule set's `bias.apex` means. They belong to the world and not to a plant,
/// so they are found once and lie in the commons.
namespace espalier::rules {

inline constexpr const char* kApices = "apices";  ///< in sim::Commons

/// Whether a rule set, or one that it leads to, asks for them.
bool asksForApices(const RuleSet& rules);

sim::Columns columnsOf(std::span<const sim::Peak> apices);

/// The unit way from a site to the nearest apex of a region; of the region that is nearest, where its name is
/// empty. Zero where there is none, or the commons know of none.
sim::Vec3 towardApex(const sim::SiteView& view, const Surroundings& around, const std::string& region);

}  // namespace espalier::rules
