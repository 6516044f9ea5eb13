#pragma once
#include <string>

#include "scenes/read/document.h"

namespace espalier::scenes {

/// The JSON Schema (draft 2020-12) of a kind of file, for editors: derived from the registries.
std::string schemaFor(FileKind kind);

}  // namespace espalier::scenes
