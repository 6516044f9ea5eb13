#include "tests/fuzz/draw_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/base/vec.h"

namespace espalier::fuzz {
namespace {

/// Where the numbers of keys usually lie that cost time or memory, or that few voxels allow; by their path.
const std::map<std::string, rules::Limits> kUsual = {
    {"random_tree.length", {0.1, 20.0}},
    {"random_tree.branch_age_range", {1.0, 6.0}},
    {"random_tree.trials.min", {1.0, 40.0}},
    {"random_tree.trials.max", {1.0, 90.0}},
    {"colonization.step", {0.1, 8.0}},
    {"colonization.influence", {1.0, 60.0}},
    {"colonization.kill", {0.1, 6.0}},
    {"colonization.trials", {1.0, 60.0}},
    {"colonization.branching.above", {0.0, 20.0}},
    {"bias.twist.radius", {0.1, 8.0}},
    {"require.age.min", {0.0, 3.0}},
    {"require.age.max", {4.0, 40.0}},
    {"require.in_region.max", {1.0, 9.0}},
    {"require.proximity.min", {0.0, 4.0}},
    {"require.proximity.max", {0.1, 30.0}},
    {"prefer.proximity", {0.0, 20.0}},
    {"stem.radius", {1e-3, 4.0}},
    {"stem.thickens", {0.0, 0.5}},
    {"stem.thickest", {1e-3, 20.0}},
    {"stem.rough.amplitude", {0.0, 4.0}},
    {"stem.rough.over", {0.5, 30.0}},
    {"stem.rough.detail", {0.2, 6.0}},
    {"elements[].trials", {1.0, 12.0}},
    {"elements[].per_segment", {0.0, 3.0}},
    {"elements[].size", {0.05, 1.6}},
    {"elements[].petiole", {0.0, 3.0}},
    {"elements[].thick", {0.0, 0.6}},
    {"elements[].share", {0.1, 4.0}},
    {"diffusion.distance", {0.3, 8.0}},
    {"diffusion.gap.min", {0.0, 2.0}},
    {"diffusion.gap.max", {0.5, 30.0}},
    {"diffusion.off", {0.1, 4.0}},
    {"elements[].phyllotaxis.spacing", {1.0, 8.0}},
    {"elements[].phyllotaxis.whorl", {1.0, 3.0}},
    {"world.layers", {0.0, 6.0}},
    {"sky.accuracy", {0.01, 0.5}},
    {"sky.directions", {1.0, 300.0}},
    {"sky.rays", {1.0, 12.0}},
    {"sun.samples", {1.0, 100.0}},
    {"sun.step", {20.0, 1440.0}},
    {"sun.accuracy", {0.3, 10.0}},
    {"exposure.band", {1.0, 6.0}},
    {"interreflection.passes", {1.0, 4.0}},
    {"interreflection.directions", {1.0, 24.0}},
    {"film.every", {3.0, 30.0}},
    {"film.hold", {0.0, 1.0}},
};

using rules::Kind;
using rules::Limits;

constexpr double kBeyondUsual = 0.02;
constexpr double kEnd = 0.12;  // of numbers that are an end of their range, each
constexpr double kWide = 400.0;

}  // namespace

std::optional<rules::Limits> usualLimits(const std::string& path) {
  const auto at = kUsual.find(path);
  return at == kUsual.end() ? std::nullopt : std::optional(at->second);
}

double ValueDrawer::number(const Limits& limits, const Limits& usual) {
  const bool unusual = usual.min > limits.min || usual.max < limits.max;
  const bool beyond = unusual && numbers_.chance(kBeyondUsual);
  beyond_usual_ = beyond_usual_ || beyond;
  const Limits& within = beyond ? limits : usual;
  const double low = std::isinf(within.min) ? -1e6 : within.min;
  const double high = std::isinf(within.max) ? 1e6 : within.max;
  if (numbers_.chance(kEnd)) return high;
  if (numbers_.chance(kEnd)) {
    if (!within.above) return low;
    constexpr std::array kAlmost{1e-300, 1e-12, 1e-6, 1e-3};
    return low + std::min(numbers_.pick(kAlmost), (high - low) / 2.0);
  }
  if (high - low <= kWide) return std::max(numbers_.uniform(low, high), within.above ? low + 1e-9 : low);
  // Over orders of magnitude from the number nearest to 0, to one side or the other.
  const double nearest = std::clamp(0.0, low, high);
  const double end = numbers_.chance(0.5) && low < nearest ? low : high;
  return nearest + (end - nearest) * std::pow(10.0, numbers_.uniform(-5.0, 0.0));
}

std::string ValueDrawer::point(double x, double y, double z) {
  return fmt::format("[{}, {}, {}]", x, y, z);
}

/// A number of voxel widths, or as many metres.
std::string ValueDrawer::length(const rules::Key& key, const Limits& usual, bool metres) {
  const double widths = number(key.limits, usual);
  if (!metres)
    return fmt::format("{}{}", widths, key.kind == Kind::size || numbers_.chance(0.9) ? "" : " vx");
  const double m = std::clamp(widths * voxel_m_, key.limits.min, key.limits.max);
  if (!rules::within(key.limits, m)) return fmt::format("{} m", std::min(1e-3, key.limits.max));
  return numbers_.chance(0.5) ? fmt::format("{} m", m) : fmt::format("{} mm", 1e3 * m);
}

/// A constant, a range or a curve.
std::string ValueDrawer::varying(const rules::Key& key, const Limits& usual) {
  const bool metres = key.kind != Kind::value && numbers_.chance(0.3);
  const auto one = [&] {
    return key.kind == Kind::value ? fmt::format("{}", number(key.limits, usual))
                                   : length(key, usual, metres);
  };
  const auto value_of = [](const std::string& text) { return std::stod(text); };
  if (numbers_.chance(0.5)) return one();
  if (numbers_.chance(0.5)) {
    std::string low = one(), high = one();
    const bool alike = (low.find("mm") == low.npos) == (high.find("mm") == high.npos);
    if (!alike || value_of(low) > value_of(high)) std::swap(low, high);
    if (!alike) return low;
    return fmt::format("[{}, {}]", low, high);
  }
  constexpr std::array kOver{"exposure", "exposure", "age", "age", "height", "height", "main"};
  std::vector<double> x;
  for (int i = numbers_.whole(2, 5); i > 0; --i)
    x.push_back(numbers_.chance(0.1) ? numbers_.uniform(-1.0, 1.0) * std::numeric_limits<double>::max()
                                     : numbers_.uniform(-1.0, 12.0));
  std::sort(x.begin(), x.end());
  std::vector<std::string> points;
  for (const double at : x) points.push_back(fmt::format("[{}, {}]", at, one()));
  return fmt::format("{{over: {}, points: [{}]}}", numbers_.pick(kOver), fmt::join(points, ", "));
}

/// Flat ones around a point near the stem.
std::string ValueDrawer::polygons(const Limits& limits, std::size_t most) {
  const bool metres = numbers_.chance(0.2);
  const auto random = [&](double to) {
    return sim::Vec3(numbers_.uniform(-to, to), numbers_.uniform(-to, to), numbers_.uniform(-to, to));
  };
  std::vector<std::string> all;
  for (int p = numbers_.chance(0.02) ? static_cast<int>(std::min<std::size_t>(most, 40))
                                     : numbers_.whole(1, 3);
       p > 0; --p) {
    const double anywhere = std::pow(10.0, numbers_.uniform(-1.5, numbers_.chance(0.03) ? 2.0 : 0.6));
    const double size = numbers_.chance(0.97) ? std::min(anywhere, 0.2 * longest_vx_) : anywhere;
    const sim::Vec3 middle = random(size), along = glm::normalize(random(1.0) + sim::Vec3(1e-3));
    const sim::Vec3 across = glm::normalize(glm::cross(along, random(1.0) + sim::Vec3(0.0, 1e-3, 0.0)));
    const int corners = numbers_.chance(0.02) ? 64 : numbers_.whole(3, 7);
    std::vector<std::string> polygon;
    for (int c = 0; c < corners; ++c) {
      const double turn = 2.0 * std::numbers::pi * c / corners, far = size * numbers_.uniform(0.3, 1.0);
      sim::Vec3 at = middle + far * (std::cos(turn) * along + std::sin(turn) * across);
      if (c == 0 && numbers_.chance(0.3)) at = sim::Vec3(0.0);  // attached there, or no longer flat
      std::array<std::string, 3> numbers;
      for (int axis = 0; axis < 3; ++axis) {
        const double n = std::clamp(metres ? at[axis] * voxel_m_ : at[axis], limits.min, limits.max);
        numbers[static_cast<std::size_t>(axis)] = fmt::format("{}{}", n, metres && n != 0.0 ? " m" : "");
      }
      polygon.push_back(fmt::format("[{}]", fmt::join(numbers, ", ")));
    }
    all.push_back(fmt::format("[{}]", fmt::join(polygon, ", ")));
  }
  return fmt::format("[{}]", fmt::join(all, ", "));
}

std::string ValueDrawer::colour() {
  const Limits whole{0.0, 1.0};
  const auto unit = [&] { return number(whole, whole); };
  if (numbers_.chance(0.5)) return fmt::format("\"#{:06x}\"", numbers_.below(1 << 24));
  return point(unit(), unit(), unit());
}

std::string ValueDrawer::date() {
  const int year = numbers_.chance(0.1) ? numbers_.whole(0, 9999) : numbers_.whole(1990, 2040);
  const int month = numbers_.whole(1, 12), day = numbers_.whole(1, 29);
  return numbers_.chance(0.3) ? fmt::format("{:02}-{:02}", month, day)
                              : fmt::format("{:04}-{:02}-{:02}", year, month, day);
}

std::string ValueDrawer::name() {
  constexpr std::array kNames{"a",     "b",     "vine", "report", "x-1.y_2", "growth",
                              "world", "plant", "-",    "0",      "null",    "true"};
  if (numbers_.chance(0.05)) return fmt::format("\"{}\"", std::string(100, 'n'));
  return fmt::format("\"{}\"", numbers_.pick(kNames));
}

/// Text of one line that somebody might write, in quotes.
std::string ValueDrawer::phrase(std::size_t most) {
  constexpr std::array kPieces{
      "ivy",        " ",       "wall: a", "# no comment", "{}",      "<b>&amp;", "%s%n",   "ü", "λ", "蔦",
      "\U0001F331", "e\u0301", "\u202e",  "../x",         "C:\\\\x", "'",        "\u00a0", "-", "0"};
  std::string text;
  for (int i = numbers_.chance(0.05) ? 300 : numbers_.whole(1, 6); i > 0; --i) text += numbers_.pick(kPieces);
  const std::size_t longest = most == 0 ? 900 : most;
  std::size_t characters = 0, end = 0;
  for (; end < text.size(); ++end) {
    const bool begins = (static_cast<unsigned char>(text[end]) & 0xc0) != 0x80;
    if (begins && ++characters > longest) break;
  }
  text.resize(end);
  while (text.ends_with('\\')) text.pop_back();
  return fmt::format("\"{}\"", text.empty() ? "x" : text);
}

std::string ValueDrawer::text(const rules::Key& key, const Limits& usual) {
  const auto whole = [&] { return static_cast<long>(std::floor(number(key.limits, usual))); };
  const auto three = [&](auto one) { return fmt::format("[{}, {}, {}]", one(), one(), one()); };
  switch (key.kind) {
    case Kind::flag:
      return numbers_.chance(0.5) ? "true" : "false";
    case Kind::whole:
      return fmt::format("{}", whole());
    case Kind::whole_range: {
      const auto [low, high] = std::minmax({whole(), whole()});
      return numbers_.chance(0.2) ? fmt::format("{}", low) : fmt::format("[{}, {}]", low, high);
    }
    case Kind::number:
      return fmt::format("{}", number(key.limits, usual));
    case Kind::value:
    case Kind::length:
    case Kind::size:
      return varying(key, usual);
    case Kind::distance:
      return length(key, usual, numbers_.chance(0.3));
    case Kind::metres:
      return fmt::format("{}", number(key.limits, usual));
    case Kind::colour:
      return colour();
    case Kind::point:
    case Kind::place:
      return three([&] { return number(key.limits, usual); });
    case Kind::pairs:
    case Kind::outline: {  // along a line, or up a tree
      const bool metres = key.kind == Kind::outline;
      std::vector<std::string> points;
      for (int i = 0; i < 4; ++i)
        points.push_back(fmt::format("[{}, {}]", metres ? i * voxel_m_ : i / 3.0, number(key.limits, usual)));
      return fmt::format("[{}]", fmt::join(points, ", "));
    }
    case Kind::polygons:
      return polygons(key.limits, key.most);
    case Kind::lines:
      return fmt::format("[[{0}, {1}, {0}], [{1}]]", three([&] { return number(key.limits, usual); }),
                         three([&] { return number(key.limits, usual); }));
    case Kind::choice:
      return numbers_.pick(key.choices);
    case Kind::name:
      return name();
    case Kind::text:
      return phrase(key.most);
    case Kind::date:
      return date();
    case Kind::header:
    case Kind::names:
    case Kind::file:
    case Kind::base:
    case Kind::rules:
    case Kind::regions:
    case Kind::section:
    case Kind::entries:
    case Kind::named:
      break;
  }
  return "";
}

}  // namespace espalier::fuzz
