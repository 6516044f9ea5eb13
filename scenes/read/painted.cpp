#include "scenes/read/painted.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "render/model/drawn_leaf.h"
#include "scenes/import/picture_reader.h"

namespace espalier::scenes {
namespace {

using rules::RuleSet;
using RulesPointer = std::shared_ptr<const RuleSet>;
using PictureOf = std::function<std::shared_ptr<const sim::Picture>(const rules::Element& element)>;

/// Rule sets are shared by those that lead to them, and stay so.
class Painting {
 public:
  explicit Painting(const PictureOf& picture) : picture_(picture) {}

  RulesPointer of(const RulesPointer& rules) {
    if (!rules) return nullptr;
    if (const auto known = done_.find(rules.get()); known != done_.end()) return known->second;
    RuleSet set = *rules;
    for (rules::Element& element : set.elements) {
      if (!element.from_here.empty()) paint(element, picture_(element), element.own_colour);
    }
    for (auto& [name, rule] : set.regions) rule.rules = of(rule.rules);
    if (set.others) set.others->rules = of(set.others->rules);
    for (RulesPointer* const other : {&set.branches, &set.twigs, &set.otherwise}) *other = of(*other);
    return done_[rules.get()] = std::make_shared<const RuleSet>(std::move(set));
  }

 private:
  const PictureOf& picture_;
  std::map<const RuleSet*, RulesPointer> done_;
};

}  // namespace

double opacityOf(const rules::Element& element, double blade) {
  // The picture is stretched over the polygons' extent, of which those near its outline have cut a part away
  // already.
  double area = 0.0;
  sim::Vec3 low(INFINITY), high(-INFINITY);
  for (const auto& polygon : element.polygons) {
    sim::Vec3 twice(0.0);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      twice += glm::cross(polygon[i], polygon[(i + 1) % polygon.size()]);
      low = glm::min(low, polygon[i]);
      high = glm::max(high, polygon[i]);
    }
    area += 0.5 * glm::length(twice);
  }
  if (!(area > 0.0)) return 1.0;
  const sim::Vec3 extent = high - low;
  return std::min(1.0, blade * std::max(1.0, std::max(extent.x, extent.z) * extent.y / area));
}

void paint(rules::Element& element, std::shared_ptr<const sim::Picture> picture, bool own_colour) {
  element.picture = std::move(picture);
  if (!own_colour) element.colour = meanColour(*element.picture);
  if (element.polygons.empty())
    element.polygons = render::cardsOf(element.picture->width, element.picture->height);
  element.opacity = opacityOf(element, render::bladeShareOf(*element.picture));
}

RulesPointer painted(const RulesPointer& rules, const PictureOf& picture) {
  return Painting(picture).of(rules);
}

}  // namespace espalier::scenes
