#pragma once
#include <memory>

#include "rules/language/key.h"

namespace espalier::rules {

/// The keys of Emission.
std::shared_ptr<const Table> emissionKeys();
/// The keys of StemEmission.
std::shared_ptr<const Table> stemEmissionKeys();

}  // namespace espalier::rules
