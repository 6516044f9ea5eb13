#include "scenes/yaml/yaml_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace espalier::scenes {
namespace {

constexpr std::string_view kDigits = "0123456789";

std::string_view takeDigits(std::string_view& text) {
  const auto end = std::min(text.find_first_not_of(kDigits), text.size());
  const auto digits = text.substr(0, end);
  text.remove_prefix(end);
  return digits;
}

/// [+-] (digits [. [digits]] | . digits) [(e|E) [+-] digits], as YAML 1.2's core schema has it.
bool isDecimal(std::string_view text, std::string& wrong) {
  wrong = "is no number";
  if (text.empty()) return false;
  if (text.front() == '+' || text.front() == '-') text.remove_prefix(1);
  const auto whole = takeDigits(text);
  if (whole.size() > 1 && whole.front() == '0') {
    wrong = "starts with a zero, which some programs take for octal";
    return false;
  }
  bool fraction = false;
  if (!text.empty() && text.front() == '.') {
    text.remove_prefix(1);
    fraction = !takeDigits(text).empty();
  }
  if (whole.empty() && !fraction) return false;
  if (!text.empty() && (text.front() == 'e' || text.front() == 'E')) {
    text.remove_prefix(1);
    if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
    if (takeDigits(text).empty()) return false;
  }
  if (!text.empty() && text.front() == ',') wrong = "is no number (a decimal point, not a comma)";
  return text.empty();
}

}  // namespace

std::optional<double> parseNumber(std::string_view text, std::string& wrong) {
  if (!isDecimal(text, wrong)) return std::nullopt;
  if (text.front() == '+') text.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) {
    wrong = "is too large or too near to 0 for a number";
    return std::nullopt;
  }
  return number == 0.0 ? 0.0 : number;  // -0 would be another byte in a hash
}

std::optional<std::int64_t> parseWhole(std::string_view text, std::string& wrong) {
  if (!isDecimal(text, wrong)) return std::nullopt;
  if (text.front() == '+') text.remove_prefix(1);
  std::int64_t whole = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), whole);
  if (error == std::errc{} && end == text.data() + text.size()) return whole;
  wrong = error == std::errc::result_out_of_range ? "is too large" : "is no whole number";
  return std::nullopt;
}

std::optional<WrittenLength> parseLength(std::string_view text, std::string& wrong) {
  using Unit = WrittenLength::Unit;
  const auto end = text.find_last_of("0123456789.");
  if (end == std::string_view::npos) {
    wrong = "is no length";
    return std::nullopt;
  }
  const auto number = parseNumber(text.substr(0, end + 1), wrong);
  if (!number) return std::nullopt;
  auto unit = text.substr(end + 1);
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  if (unit.empty() && end + 1 == text.size()) return WrittenLength{*number, Unit::none};
  if (unit == "vx") return WrittenLength{*number, Unit::voxels};
  if (unit == "m") return WrittenLength{*number, Unit::metres};
  // Divided, not multiplied: 4 / 100 is the double nearest to 0.04, 4 * 0.01 is so only by luck.
  if (unit == "cm") return WrittenLength{*number / 100.0, Unit::metres};
  if (unit == "mm") return WrittenLength{*number / 1000.0, Unit::metres};
  wrong = "has no unit that is known (mm, cm, m, vx)";
  return std::nullopt;
}

}  // namespace espalier::scenes
