#pragma once
#include "rules/language/key.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// Complains of what a scene makes (pieces, heights) whose names are no names of files, or those of other
/// files that a run writes.
void checkMadeNames(const Scene& scene, const rules::Check::Given& given,
                    const rules::Check::Complain& complain);

}  // namespace espalier::scenes
