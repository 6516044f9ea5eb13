#include "scenes/clean_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

namespace espalier::scenes {
namespace {

// No file's name is ever cut: file systems allow 255 bytes.
constexpr std::size_t kLongestWord = 256;
constexpr std::size_t kLongestLine = 1024;

/// Marks and overrides of direction, and separators of lines and paragraphs (Unicode 15, bidirectional
/// controls).
bool turnsTheLine(std::uint32_t code) {
  return code == 0x61c || code == 0x200e || code == 0x200f || (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069);
}

std::string escaped(std::uint32_t code) {
  switch (code) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      return code < 0x80 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{:04x}", code);
  }
}

bool startsCharacter(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
}

std::size_t charactersIn(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), startsCharacter));
}

/// Where a text's character of this number begins.
std::size_t byteOf(std::string_view text, std::size_t character) {
  std::size_t at = 0;
  for (; at < text.size(); ++at) {
    if (startsCharacter(text[at]) && character-- == 0) break;
  }
  return at;
}

}  // namespace

std::string cleanText(std::string_view text) {
  const auto quoted = nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  auto clean = nlohmann::json::parse(quoted).get<std::string>();
  std::replace_if(
      clean.begin(), clean.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  const auto first = clean.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return clean.substr(first, clean.find_last_not_of(' ') + 1 - first);
}

Character characterAt(std::string_view rest) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(rest[i]));
  };
  const std::uint32_t first = byte(0);
  const std::size_t bytes = first < 0x80   ? 1
                            : first < 0xc2 ? 0
                            : first < 0xe0 ? 2
                            : first < 0xf0 ? 3
                            : first < 0xf5 ? 4
                                           : 0;
  if (bytes == 0 || rest.size() < bytes) return {};
  std::uint32_t code = bytes == 1 ? first : first & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = (code << 6) | (byte(i) & 0x3f);
  }
  const bool overlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return overlong || surrogate || code > 0x10ffff ? Character{} : Character{code, bytes};
}

bool isControl(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0);
}

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const auto [code, bytes] = characterAt(text);
    if (bytes == 0) {
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    } else if (isControl(code) || turnsTheLine(code)) {
      shown += escaped(code);
    } else {
      shown += text.substr(0, bytes);
    }
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return shown;
}

std::string shortened(std::string_view text, std::size_t most) {
  constexpr std::string_view kGap = "...";
  const std::size_t characters = charactersIn(text);
  if (characters <= most) return std::string(text);
  const std::size_t tail = (most - kGap.size()) / 3;
  const std::size_t head = most - kGap.size() - tail;
  return fmt::format("{}{}{}", text.substr(0, byteOf(text, head)), kGap,
                     text.substr(byteOf(text, characters - tail)));
}

std::string oneLine(std::string_view text) {
  const std::string all = printable(text);
  std::string line;
  for (std::string_view rest = all;;) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    line += shortened(rest.substr(0, end), kLongestWord);
    if (end == rest.size()) break;
    line += ' ';
    rest.remove_prefix(end + 1);
  }
  return shortened(line, kLongestLine);
}

std::string printableJson(std::string_view json) {
  std::string shown;
  while (!json.empty()) {
    const auto [code, bytes] = characterAt(json);
    // Line ends stand between values only.
    if (bytes > 0 && code != '\n' && (isControl(code) || turnsTheLine(code))) {
      fmt::format_to(std::back_inserter(shown), "\\u{:04x}", code);
    } else {
      shown += json.substr(0, std::max<std::size_t>(bytes, 1));
    }
    json.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return shown;
}

}  // namespace espalier::scenes
