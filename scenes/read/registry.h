#pragma once
#include <vector>

#include "rules/language/key.h"

/// The registry of scene files: every key stands here once, with its type, unit, default, range and meaning.
/// The reader, the JSON Schema and the reference page walk it.
///
/// To add a key: give the struct in scenes/scene.h a field with its default, and add one line to the table of
/// that struct in scenes/read/registry.cpp. Then run the scenes tests once with ESPALIER_UPDATE_DOCS=1.
namespace espalier::scenes {

/// The keys of a scene; its struct is Scene.
const rules::Table& sceneTable();
/// What must hold between them.
const std::vector<rules::Check>& sceneChecks();

}  // namespace espalier::scenes
