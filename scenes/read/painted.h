#pragma once
#include <functional>
#include <memory>

#include "rules/language/rule_set.h"
#include "sim/base/picture.h"

/// What a picture makes of the element that it is painted on.
namespace espalier::scenes {

/// How much of an element's polygons is left of them, 0..1, where of an upright card such a share is blade.
double opacityOf(const rules::Element& element, double blade);

/// Puts a picture on an element: its mean colour on one without a colour of its own, and cards that fit under
/// it where it has no polygons.
void paint(rules::Element& element, std::shared_ptr<const sim::Picture> picture, bool own_colour);

/// A rule set, and all that it leads to, with the pictures on its elements that are products of scenes, as
/// `picture` finds them.
std::shared_ptr<const rules::RuleSet> painted(
    const std::shared_ptr<const rules::RuleSet>& rules,
    const std::function<std::shared_ptr<const sim::Picture>(const rules::Element& element)>& picture);

}  // namespace espalier::scenes
