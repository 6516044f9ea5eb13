#pragma once
#include <string>

#include "scenes/read/document.h"

namespace espalier::scenes {

/// The reference page of a kind of file, in Markdown: every key with its unit, default, range and meaning,
/// and for rules the name that Greene gave it. Derived from the registries.
std::string referenceFor(FileKind kind);

}  // namespace espalier::scenes
