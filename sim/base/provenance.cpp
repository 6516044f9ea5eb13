#include "sim/base/provenance.h"

#include <fmt/format.h>

namespace espalier::sim {

std::string hexOf(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

std::string listOf(const std::vector<InputFile>& inputs) {
  std::string text;
  for (const InputFile& input : inputs)
    text += fmt::format("{}{} {} {}", text.empty() ? "" : "\n", hexOf(input.hash), input.kind, input.name);
  return text;
}

}  // namespace espalier::sim
