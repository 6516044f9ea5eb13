#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Numbers as files may write them, the same in every locale: decimal, finite, without leading zeros,
/// underscores or decimal commas. yaml-cpp would read 010 as 8 and yes as true.
namespace espalier::scenes {

/// `wrong` says what keeps a text from being a number: "is no number", "starts with a zero ...".
std::optional<double> parseNumber(std::string_view text, std::string& wrong);
std::optional<std::int64_t> parseWhole(std::string_view text, std::string& wrong);

/// A number, or a number with a unit.
struct WrittenLength {
  enum class Unit { none, voxels, metres };
  double number = 0.0;  ///< in metres where the unit is mm, cm or m
  Unit unit = Unit::none;
};
std::optional<WrittenLength> parseLength(std::string_view text, std::string& wrong);

}  // namespace espalier::scenes
