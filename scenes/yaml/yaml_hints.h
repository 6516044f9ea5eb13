#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace espalier::scenes {

/// What yaml-cpp complained of, in words for somebody who has lost a bracket or a colon. `line` counts from
/// 0.
std::string explained(const std::string& message, const std::string& text, int line);

/// "; did you mean 'length: 2.4'?" for "length:2.4" where length is one of the names.
std::string spacedColon(std::string_view word, const std::vector<std::string>& names);

}  // namespace espalier::scenes
