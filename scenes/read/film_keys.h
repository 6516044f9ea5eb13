#pragma once
#include <memory>

#include "rules/language/key.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// Keys of a FilmSpec.
std::shared_ptr<const rules::Table> filmKeys();

/// A film has cameras that the scene has, in order, frames that a codec takes, and files of its own.
void checkFilm(const Scene& scene, const rules::Check::Given& given, const rules::Check::Complain& complain);

}  // namespace espalier::scenes
