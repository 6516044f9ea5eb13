#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

/// Text that nobody has vouched for: from files, names and the command line.
namespace espalier::scenes {

/// Text from a file, fit to be shown and written: bytes that are not UTF-8 become U+FFFD, control characters
/// spaces, and spaces at both ends go.
std::string cleanText(std::string_view text);

/// The character at the front of a text that is not empty.
struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  ///< 0: what stands there is no well-formed UTF-8 (RFC 3629)
};
Character characterAt(std::string_view rest);

/// C0, DEL and C1.
bool isControl(std::uint32_t code);

/// The text with no character that a terminal obeys instead of showing it: control characters, line ends,
/// those that turn the direction of what follows, and bytes that are no UTF-8 become escapes: a
/// backslash and n, x1b or u202e.
std::string printable(std::string_view text);

/// Cut short in its middle to at most so many characters, where "..." then stands.
std::string shortened(std::string_view text, std::size_t most);

/// Printable, and no longer than somebody will read: long words, such as paths, and the whole are cut short
/// in their middle, so that what stands at both ends is kept. The same again for what it gives.
std::string oneLine(std::string_view text);

/// JSON with the same values, in which such characters are escapes of JSON's own.
std::string printableJson(std::string_view json);

}  // namespace espalier::scenes
