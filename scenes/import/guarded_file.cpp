#include "scenes/import/guarded_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "scenes/clean_text.h"
#include "sim/base/error.h"

namespace espalier::scenes {

std::uintmax_t sizeOfFile(const std::filesystem::path& file, const std::string& what) {
  struct stat about {};
  if (::stat(file.c_str(), &about) != 0)
    throw sim::InputError(fmt::format("cannot open the {}: {}", what, std::strerror(errno)));
  if (S_ISDIR(about.st_mode)) throw sim::InputError(fmt::format("is a folder, not a {} file", what));
  if (!S_ISREG(about.st_mode)) throw sim::InputError("is not a regular file");
  if (::access(file.c_str(), R_OK) != 0)
    throw sim::InputError(fmt::format("cannot open the {}: {}", what, std::strerror(errno)));
  const auto bytes = static_cast<std::uintmax_t>(about.st_size);
  if (bytes == 0) throw sim::InputError("the file is empty");
  if (bytes > kMostFileBytes) {
    throw sim::InputError(fmt::format("the file has {} MB; a {} file may have at most {} MB", bytes >> 20,
                                      what, kMostFileBytes >> 20));
  }
  return bytes;
}

// A 2.4 MB OBJ file takes a quarter of a second on a common machine.
ChildLimits limitsFor(std::uintmax_t bytes) {
  ChildLimits limits;
  limits.cpu = std::chrono::seconds(10 + static_cast<long>(bytes >> 22));
  limits.wall = 20 * limits.cpu;  // the reader waits for nothing but a processor
  return limits;
}

std::string readInChild(const FileReading& reading, const ChildLimits& limits, const std::string& what) {
  ChildResult result = readBeside(reading, limits);
  switch (result.end) {
    case ChildEnd::finished:
      break;
    case ChildEnd::threw:
      throw sim::InputError(cleanText(result.bytes));
    case ChildEnd::crashed:
      throw sim::InputError(
          fmt::format("the file is damaged: it made the {} reader crash ({})", what, result.bytes));
    case ChildEnd::out_of_time:
      throw sim::InputError(
          fmt::format("the file is damaged or far too complex: the {} reader was not done with it in {} s",
                      what, limits.cpu.count()));
    case ChildEnd::out_of_memory:
      throw sim::InputError(
          fmt::format("the file is damaged or far too complex: reading it took more than {} MB",
                      limits.memory_bytes >> 20));
  }
  return std::move(result.bytes);
}

}  // namespace espalier::scenes
