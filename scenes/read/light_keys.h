#pragma once
#include <memory>

#include "rules/language/key.h"
#include "scenes/scene.h"

/// The keys `sky`, `sun` and `interreflection` of scene files.
namespace espalier::scenes {

std::shared_ptr<const rules::Table> skyKeys();
std::shared_ptr<const rules::Table> sunKeys();
std::shared_ptr<const rules::Table> interreflectionKeys();

/// What must hold between them.
void checkSky(const Scene& scene, const rules::Check::Given& given, const rules::Check::Complain& complain);
void checkBackground(const Scene& scene, const rules::Check::Given& given,
                     const rules::Check::Complain& complain);
void checkSun(const Scene& scene, const rules::Check::Given& given, const rules::Check::Complain& complain);

}  // namespace espalier::scenes
