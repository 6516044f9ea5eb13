#include "scenes/clean_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace espalier::scenes {

std::string cleanText(std::string_view text) {
  const auto quoted = nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  auto clean = nlohmann::json::parse(quoted).get<std::string>();
  std::replace_if(
      clean.begin(), clean.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  const auto first = clean.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return clean.substr(first, clean.find_last_not_of(' ') + 1 - first);
}

}  // namespace espalier::scenes
