#pragma once
#include <memory>

#include "rules/language/key.h"

namespace espalier::rules {

/// The keys of Colonization.
std::shared_ptr<const Table> colonizationKeys();

}  // namespace espalier::rules
