#pragma once
#include "rules/language/key.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// What must hold between the keys of a scene's attractors.
void checkAttractors(const Scene& scene, const rules::Check::Given& given,
                     const rules::Check::Complain& complain);

/// Plants grow to attractors that the scene has, along fields that it has.
void checkFronts(const Scene& scene, const rules::Check::Given& given,
                 const rules::Check::Complain& complain);

/// Fields have an axis, and boxes an inside; they hold in meshes that the scene has.
void checkFields(const Scene& scene, const rules::Check::Given& given,
                 const rules::Check::Complain& complain);

}  // namespace espalier::scenes
