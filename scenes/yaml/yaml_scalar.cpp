#include "scenes/yaml/yaml_scalar.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "rules/language/colour.h"
#include "sim/light/sun.h"

namespace espalier::scenes {

using rules::Kind;
using Node = YamlNode;
using Unit = WrittenLength::Unit;

constexpr std::size_t kLongestText = 1000;

std::nullopt_t ScalarReader::say(const Node& node, std::string text) const {
  if (!node.refused) problems.add(node.place, std::move(text));
  return std::nullopt;
}

std::nullopt_t ScalarReader::fail(const Node& node, std::string_view what) const {
  return say(node, fmt::format("{} {}; expected {}", path, what, rules::expectation(key)));
}

std::nullopt_t ScalarReader::mismatch(const Node& node) const {
  if (node.kind != Node::Kind::null) return fail(node, fmt::format("is {}", described(node)));
  return fail(node,
              key.kind == Kind::colour ? "has no value (an unquoted # begins a comment)" : "has no value");
}

std::nullopt_t ScalarReader::wrongScalar(const Node& node, std::string_view wrong) const {
  return fail(node, fmt::format("is {}, which {}", described(node), wrong));
}

/// A scalar that may be a number or a flag: texts in quotes are neither.
bool ScalarReader::isPlain(const Node& node) const {
  if (node.kind != Node::Kind::scalar) {
    mismatch(node);
  } else if (node.quoted) {
    wrongScalar(node, "is text in quotes");
  }
  return node.kind == Node::Kind::scalar && !node.quoted;
}

std::optional<double> ScalarReader::anyNumber(const Node& node) const {
  if (!isPlain(node)) return std::nullopt;
  std::string wrong;
  const auto number = parseNumber(node.text, wrong);
  if (number) return number;
  std::string not_even;
  const auto length = parseLength(node.text, not_even);
  return wrongScalar(node, length && length->unit != Unit::none ? "is a length" : wrong);
}

std::optional<double> ScalarReader::number(const Node& node) const {
  const auto number = anyNumber(node);
  if (number && !rules::within(key.limits, *number)) return wrongScalar(node, "is out of range");
  return number;
}

std::optional<std::int64_t> ScalarReader::whole(const Node& node) const {
  if (!isPlain(node)) return std::nullopt;
  std::string wrong;
  const auto whole = parseWhole(node.text, wrong);
  if (!whole) return wrongScalar(node, wrong);
  if (!rules::within(key.limits, static_cast<double>(*whole))) return wrongScalar(node, "is out of range");
  return whole;
}

std::optional<WrittenLength> ScalarReader::length(const Node& node) const {
  if (node.kind != Node::Kind::scalar) return mismatch(node);
  std::string wrong;
  const auto read = parseLength(node.text, wrong);
  if (!read) return wrongScalar(node, wrong);
  if (node.quoted && read->unit == Unit::none) return wrongScalar(node, "is text in quotes, without a unit");
  if (!rules::within(key.limits, read->number)) return wrongScalar(node, "is out of range");
  return read;
}

std::optional<double> ScalarReader::metres(const Node& node) const {
  const auto read = length(node);
  if (!read) return std::nullopt;
  if (read->unit == Unit::voxels) return wrongScalar(node, "is in voxel widths, which a scene does not know");
  return read->number;
}

std::optional<bool> ScalarReader::flag(const Node& node) const {
  if (!isPlain(node)) return std::nullopt;
  if (node.text == "true") return true;
  if (node.text == "false") return false;
  return wrongScalar(node, "is neither");
}

std::optional<std::string> ScalarReader::text(const Node& node) const {
  if (node.kind != Node::Kind::scalar) return mismatch(node);
  if (node.refused) return std::nullopt;
  if (node.text.empty()) return fail(node, "is empty");
  const auto most = key.kind == Kind::text && key.most > 0 ? key.most : kLongestText;
  const auto length = static_cast<std::size_t>(std::count_if(node.text.begin(), node.text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
  if (length > most) return fail(node, fmt::format("is a text of {} characters, more than {}", length, most));
  if (node.text.find('\n') != node.text.npos) return wrongScalar(node, "has more than one line");
  return node.text;
}

std::optional<std::chrono::year_month_day> ScalarReader::date(const Node& node) const {
  const auto read = text(node);
  if (!read) return std::nullopt;
  std::string_view shape = *read;
  const auto number = [&](std::size_t digits) -> std::optional<int> {
    int value = 0;
    const auto [end, error] =
        std::from_chars(shape.data(), shape.data() + std::min(digits, shape.size()), value);
    if (error != std::errc{} || end != shape.data() + digits || shape[0] == '-') return std::nullopt;
    shape.remove_prefix(digits);
    return value;
  };
  const auto dash = [&] {
    const bool here = shape.starts_with('-');
    shape.remove_prefix(here ? 1 : 0);
    return here;
  };
  std::optional<int> year = static_cast<int>(sim::kUsualYear);
  constexpr std::size_t kWithYear = 10, kWithout = 5;  // 2026-06-21, 06-21
  if (shape.size() == kWithYear) {
    year = number(4);
    if (!year || !dash()) return wrongScalar(node, "is no date");
  } else if (shape.size() != kWithout) {
    return wrongScalar(node, "is no date");
  }
  const auto month = number(2);
  const bool parted = month && dash();
  const auto day = parted ? number(2) : std::nullopt;
  if (!day) return wrongScalar(node, "is no date");
  const std::chrono::year_month_day date{std::chrono::year{*year},
                                         std::chrono::month{static_cast<unsigned>(*month)},
                                         std::chrono::day{static_cast<unsigned>(*day)}};
  if (!date.ok()) return wrongScalar(node, "is a day that does not exist");
  return date;
}

std::optional<std::string> ScalarReader::name(const Node& node) const {
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  constexpr std::size_t kLongest = 100;
  const auto read = text(node);
  if (!read) return std::nullopt;
  if (read->find_first_not_of(kAllowed) != read->npos)
    return wrongScalar(node, "has characters that a file name should not have");
  if (read->front() == '.' || read->size() > kLongest)
    return wrongScalar(node, "cannot be part of a file name");
  return read;
}

std::optional<std::string> ScalarReader::choice(const Node& node) const {
  const auto read = text(node);
  if (!read || std::find(key.choices.begin(), key.choices.end(), *read) != key.choices.end()) return read;
  return say(node, fmt::format("{} is {}; expected {}{}", path, inQuotes(*read), rules::expectation(key),
                               didYouMean(*read, key.choices)));
}

std::optional<sim::Colour> ScalarReader::hexColour(const Node& node) const {
  if (node.kind != Node::Kind::scalar) return mismatch(node);
  const std::string_view text = node.text;
  if (text.size() != 7 || text[0] != '#' ||
      text.find_first_not_of("0123456789abcdefABCDEF", 1) != text.npos) {
    return wrongScalar(node, "is no colour");
  }
  const auto channel = [&](std::size_t at) {
    return static_cast<float>(std::stoi(std::string(text.substr(at, 2)), nullptr, 16)) / 255.0f;
  };
  return rules::linearFromSrgb({channel(1), channel(3), channel(5)});
}

}  // namespace espalier::scenes
