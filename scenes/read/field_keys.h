#pragma once
#include <memory>

#include "rules/language/key.h"

namespace espalier::scenes {

/// Keys of a FieldSpec.
std::shared_ptr<const rules::Table> fieldKeys();

}  // namespace espalier::scenes
