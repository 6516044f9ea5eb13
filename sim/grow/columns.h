#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/vec.h"

/// Named columns: how growth remembers. A plain value that can be copied, hashed and saved by anybody, and
/// understood by the process that wrote it.
namespace espalier::sim {

using Column = std::variant<std::vector<std::int32_t>, std::vector<std::int64_t>, std::vector<float>,
                            std::vector<double>, std::vector<Vec3>>;
using Columns = std::map<std::string, Column, std::less<>>;

/// The column of that name, made empty where there is none. Throws BrokenContract where it holds another
/// type.
template <typename T>
std::vector<T>& column(Columns& columns, std::string_view name) {
  auto at = columns.find(name);
  if (at == columns.end()) at = columns.emplace(name, std::vector<T>()).first;
  if (auto* const values = std::get_if<std::vector<T>>(&at->second)) return *values;
  throw BrokenContract("the column " + std::string(name) + " holds another type");
}

/// The same of columns that are only read: an empty one where there is none.
template <typename T>
const std::vector<T>& column(const Columns& columns, std::string_view name) {
  static const std::vector<T> none;
  const auto at = columns.find(name);
  if (at == columns.end()) return none;
  if (const auto* const values = std::get_if<std::vector<T>>(&at->second)) return *values;
  throw BrokenContract("the column " + std::string(name) + " holds another type");
}

}  // namespace espalier::sim
