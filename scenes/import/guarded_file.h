#pragma once
#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>

#include "scenes/clean_text.h"
#include "scenes/import/child_process.h"
#include "scenes/import/reading.h"
#include "sim/base/error.h"

/// Files of strangers, read by libraries that they can break.
namespace espalier::scenes {

/// The most that a file may have, and each file that it names.
inline constexpr std::uintmax_t kMostFileBytes = std::uintmax_t{256} << 20;

/// The size of a regular file that can be read. `what` it is, such as "mesh". Throws sim::InputError, without
/// the file's name, for anything else, for an empty file and for one above kMostFileBytes.
std::uintmax_t sizeOfFile(const std::filesystem::path& file, const std::string& what);

/// Ample for a file of that size on slow machines.
ChildLimits limitsFor(std::uintmax_t bytes);

/// What a reader makes of a file in a child process. `what` the file is, in words. Throws sim::InputError,
/// without the file's name, with what the reader throws there, or that it crashed, took too long or too much
/// memory.
std::string readInChild(const FileReading& reading, const ChildLimits& limits, const std::string& what);

/// What `unpack` makes of that: it does not trust the bytes, and throws a std::exception where they make no
/// sense. Throws sim::InputError then too.
template <class Unpack>
auto readInChild(const FileReading& reading, const ChildLimits& limits, const std::string& what, Unpack unpack) {
  const std::string bytes = readInChild(reading, limits, what);
  try {
    return unpack(bytes);
  } catch (const std::exception& error) {
    throw sim::InputError("the file is damaged: it confused the " + what + " reader (" + error.what() + ")");
  }
}

/// What `work` returns. A sim::InputError of its own begins with the file's path then, in one line.
template <class Work>
auto namingFile(const std::filesystem::path& file, Work work) {
  try {
    return work();
  } catch (const sim::InputError& error) {
    throw sim::InputError(file.string() + ": " + cleanText(error.what()));
  }
}

}  // namespace espalier::scenes
