#pragma once
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// One reader of ours that is given bytes from nowhere. Each target is a file NAME_target.cpp that defines
/// both functions below; libFuzzer drives it in the preset `fuzz`, replay.cpp everywhere else.

/// Reads the bytes. Whatever they are, it comes back: what the reader may not do ends the program.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace espalier::fuzz {

/// Small inputs that are as they should be, to begin with.
std::vector<std::string> seeds();

/// What must hold of whatever was read; ends the program where it does not.
inline void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace espalier::fuzz
