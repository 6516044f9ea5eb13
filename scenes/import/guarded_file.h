#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "scenes/import/child_process.h"

/// Files of strangers, read by libraries that they can break.
namespace espalier::scenes {

/// The most that a file may have, and each file that it names.
inline constexpr std::uintmax_t kMostFileBytes = std::uintmax_t{256} << 20;

/// The size of a regular file that can be read. `what` it is, such as "mesh". Throws sim::InputError, without
/// the file's name, for anything else, for an empty file and for one above kMostFileBytes.
std::uintmax_t sizeOfFile(const std::filesystem::path& file, const std::string& what);

/// Ample for a file of that size on slow machines.
ChildLimits limitsFor(std::uintmax_t bytes);

/// What `work` returns, which reads a file in a child process. Throws sim::InputError, without the file's
/// name, with what it throws there, or that it crashed, took too long or too much memory.
std::string readInChild(const std::function<std::string()>& work, const ChildLimits& limits,
                        const std::string& what);

}  // namespace espalier::scenes
