#pragma once
#include <string>
#include <string_view>

namespace espalier::scenes {

/// Text from a file that nobody has vouched for, fit to be shown and written: bytes that are not UTF-8 become
/// U+FFFD, control characters spaces, and spaces at both ends go.
std::string cleanText(std::string_view text);

}  // namespace espalier::scenes
