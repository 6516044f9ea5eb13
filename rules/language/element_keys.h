#pragma once
#include <memory>

#include "rules/language/key.h"

namespace espalier::rules {

/// The keys of Stem and of Element: what a plant looks like.
std::shared_ptr<const Table> stemKeys();
std::shared_ptr<const Table> elementKeys();

}  // namespace espalier::rules
