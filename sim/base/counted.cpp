#include "sim/base/counted.h"

#include <fmt/format.h>

namespace espalier::sim {

std::string counted(std::uint64_t number, std::string_view one, std::string_view many) {
  if (number == 1 || !many.empty()) return fmt::format("{} {}", number, number == 1 ? one : many);
  return fmt::format("{} {}s", number, one);
}

}  // namespace espalier::sim
