#pragma once
#include <string>

namespace espalier::scenes {

/// What the registries say of the keys of that name in rule and scene files: what they do, what they may be,
/// and where they stand. `name`: a key's path ("elements.size", "elements[].size"), its last words ("size"),
/// or the name that Greene gave it. Throws sim::InputError for another word, with the nearest name.
std::string explainKey(const std::string& name);

}  // namespace espalier::scenes
