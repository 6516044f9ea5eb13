#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace espalier::tests {

/// A PNG of any size and depth, also of one that its data do not hold: `type` as the PNG specification
/// numbers kinds of colour, samples row by row, their high bytes first. What is there is stored as it is.
inline std::string pngBytes(std::uint32_t width, std::uint32_t height, int depth, int type,
                            const std::vector<std::uint8_t>& samples) {
  const auto big = [](std::uint32_t n) {
    return std::string{static_cast<char>(n >> 24), static_cast<char>(n >> 16), static_cast<char>(n >> 8),
                       static_cast<char>(n)};
  };
  const auto chunk = [&](const std::string& kind, const std::string& data) {
    std::uint32_t crc = 0xffffffffu;
    for (const char c : kind + data) {
      crc ^= static_cast<std::uint8_t>(c);
      for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0u);
    }
    return big(static_cast<std::uint32_t>(data.size())) + kind + data + big(~crc);
  };
  const std::size_t row = samples.size() / height;
  std::string raw;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (row == 0 || i % row == 0) raw += '\0';  // no filter
    raw += static_cast<char>(samples[i]);
  }
  std::uint32_t a = 1, b = 0;
  for (const char c : raw) {
    a = (a + static_cast<std::uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint16_t>(raw.size());
  const std::string block{'\x01', static_cast<char>(size), static_cast<char>(size >> 8),
                          static_cast<char>(~size), static_cast<char>(~size >> 8)};
  const std::string head =
      big(width) + big(height) + static_cast<char>(depth) + static_cast<char>(type) + std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", head) +
         chunk("IDAT", "\x78\x01" + block + raw + big(b << 16 | a)) + chunk("IEND", "");
}

}  // namespace espalier::tests
