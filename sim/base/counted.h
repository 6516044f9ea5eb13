#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace espalier::sim {

/// "1 leaf", "0 leaves", "2 leaves". `many`: by itself the one with an s.
std::string counted(std::uint64_t number, std::string_view one, std::string_view many = {});

}  // namespace espalier::sim
