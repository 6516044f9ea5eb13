#pragma once
#include "rules/language/key.h"

/// Internal to the wing: units and ranges of more than one table of keys.
namespace espalier::scenes {

inline constexpr rules::Limits kCoordinate{-1e6, 1e6};  ///< metres
inline constexpr const char* kMetres = "metres";
inline constexpr const char* kDegrees = "degrees";

}  // namespace espalier::scenes
