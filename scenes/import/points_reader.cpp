#include "scenes/import/points_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>

#include "scenes/import/guarded_file.h"
#include "scenes/problem.h"
#include "sim/base/error.h"
#include "sim/base/hasher.h"

namespace espalier::scenes {
namespace {

constexpr double kFarthest_m = 1e6;

std::string bytesOf(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw sim::InputError(fmt::format("{}: is no file; expected a table of points", file.string()));
  const auto size = std::filesystem::file_size(file, error);
  if (!error && size > kMostFileBytes)
    throw sim::InputError(fmt::format("{}: the file has {} MB; a table of points may have at most {} MB",
                                      file.string(), size >> 20, kMostFileBytes >> 20));
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw sim::InputError(fmt::format("{}: cannot be read", file.string()));
  return bytes;
}

std::string_view withoutSpace(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
  return text.substr(0, text.find_last_not_of(kSpace) + 1);
}

/// Takes the first of a line's columns off.
std::string_view takeColumn(std::string_view& line) {
  const auto end = std::min(line.find(','), line.size());
  const std::string_view column = withoutSpace(line.substr(0, end));
  line.remove_prefix(std::min(end + 1, line.size()));
  return column;
}

template <class Number>
bool parseNumber(std::string_view column, Number& number) {
  const char* const end = column.data() + column.size();
  const auto [stopped, error] = std::from_chars(column.data(), end, number);
  return error == std::errc() && stopped == end;
}

/// A point, or false; its type too, where that is asked for.
bool parsePoint(std::string_view line, sim::Vec3& point, int* type) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!parseNumber(takeColumn(line), point[axis]) || !(std::abs(point[axis]) <= kFarthest_m)) return false;
  }
  return type == nullptr || parseNumber(takeColumn(line), *type);
}

bool namesColumns(std::string_view line) {
  const char first = line.front();
  return (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z') || first == '"';
}

}  // namespace

std::vector<sim::Vec3> readPoints(const std::filesystem::path& file, std::optional<int> type,
                                  sim::InputFile& read) {
  const std::string bytes = bytesOf(file);
  read = {file.filename().string(), "points", sim::hashOf(bytes)};
  std::vector<sim::Vec3> points;
  std::string_view rest = bytes;
  bool first = true;
  for (int number = 1; !rest.empty(); ++number) {
    const auto end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = withoutSpace(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.empty() || line.front() == '#') continue;
    sim::Vec3 point(0.0);
    int of_type = 0;
    if (parsePoint(line, point, type ? &of_type : nullptr)) {
      if (!type || of_type == *type) points.push_back(point);
    } else if (!first || !namesColumns(line)) {
      throw sim::InputError(
          fmt::format("{}:{}: {} is no point{}; expected x, y, z in metres, each from {} to {}{}",
                      file.string(), number, inQuotes(line.substr(0, 60)), type ? " with a type" : "",
                      -kFarthest_m, kFarthest_m, type ? ", and a whole number" : ""));
    }
    first = false;
  }
  if (points.empty())
    throw sim::InputError(fmt::format("{}: has no points{}; expected x, y, z on each line", file.string(),
                                      type ? fmt::format(" of type {}", *type) : ""));
  return points;
}

}  // namespace espalier::scenes
