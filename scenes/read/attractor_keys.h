#pragma once
#include <memory>

#include "rules/language/key.h"

namespace espalier::scenes {

/// What types points of tables may have.
inline constexpr rules::Limits kPointTypes{0.0, 1e6};

/// Keys of an AttractorsSpec.
std::shared_ptr<const rules::Table> attractorKeys();

}  // namespace espalier::scenes
