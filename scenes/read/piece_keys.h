#pragma once
#include <memory>

#include "rules/language/key.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// The keys of one of a scene's `pieces`.
std::shared_ptr<const rules::Table> pieceKeys();

/// What they must agree on, and images of them.
void checkPieces(const Scene& scene, const rules::Check::Given& given,
                 const rules::Check::Complain& complain);

}  // namespace espalier::scenes
