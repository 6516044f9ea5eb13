#pragma once
#include <memory>

#include "rules/language/key.h"

namespace espalier::rules {

/// The keys of Emission.
std::shared_ptr<const Table> emissionKeys();

}  // namespace espalier::rules
