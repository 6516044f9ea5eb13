#pragma once
#include <optional>

#include "rules/language/key.h"
#include "scenes/problem.h"
#include "scenes/yaml/yaml_tree.h"

namespace espalier::scenes {

/// A node as the datum that a key expects, or nothing after every problem with it was reported. For all kinds
/// but header, base, rules, regions and those with keys of their own. `path` names the key in messages.
std::optional<rules::Datum> readDatum(const YamlNode& node, const rules::Key& key, const std::string& path,
                                      Problems& problems);

}  // namespace espalier::scenes
