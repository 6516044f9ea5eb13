#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "scenes/problem.h"

namespace espalier::scenes {

/// Largest rule or scene file. yaml-cpp needs up to 270 bytes of memory for one of the file.
inline constexpr std::size_t kMaxTextBytes = 1'000'000;

/// The bytes of a text file, without a byte order mark. Refuses (as a problem of `asker`, or of the file
/// itself) what is not a regular file (a pipe would hang), what is too large, and what cannot be read. `hash`
/// is of all the file's bytes.
std::optional<std::string> readText(const std::string& path, const Place& asker, Problems& problems,
                                    std::uint64_t* hash = nullptr);

/// Refuses what is no UTF-8 and the control characters that no editor shows: yaml-cpp passes them on.
/// Every bad line is reported once.
bool checkText(const std::string& text, const std::shared_ptr<const std::string>& path, Problems& problems);

}  // namespace espalier::scenes
