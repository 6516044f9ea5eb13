#pragma once
#include <memory>

#include "rules/language/key.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// Keys of a HeightsSpec.
std::shared_ptr<const rules::Table> heightsKeys();

/// Heights are of plants that the scene has, over a rectangle with an inside, and written under names that no
/// other file has.
void checkHeights(const Scene& scene, const rules::Check::Given& given,
                  const rules::Check::Complain& complain);

/// Images show heights that the scene has.
void checkImageHeights(const Scene& scene, const rules::Check::Given& given,
                       const rules::Check::Complain& complain);

}  // namespace espalier::scenes
