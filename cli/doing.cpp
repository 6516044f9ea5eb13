#include "cli/doing.h"

#include <fmt/format.h>
#include <unistd.h>

#include <exception>
#include <filesystem>
#include <mutex>
#include <new>
#include <system_error>

#include "cli/commands.h"
#include "cli/say.h"
#include "sim/base/whole_file.h"

namespace espalier::cli {
namespace {

std::mutex mutex;
std::string file_now = "espalier", stage_now = "starting";

/// Of the exception that is being handled.
std::string whatHappened() {
  const auto unforeseen = [](const std::string& what) {
    return fmt::format(
        "something that was not foreseen{}; if threads, memory and disks suffice, it is a fault of the "
        "program: please report it with the file",
        what);
  };
  try {
    throw;
  } catch (const sim::InputError&) {
    throw;
  } catch (const sim::Stopped&) {
    throw;
  } catch (const Failure&) {
    throw;
  } catch (const std::bad_alloc&) {
    return "out of memory; use larger voxels, fewer iterations, smaller images or fewer threads";
  } catch (const std::filesystem::filesystem_error& error) {
    return fmt::format("the system refuses {} ({})", error.path1().string(), error.code().message());
  } catch (const std::system_error& error) {
    return fmt::format("the system refuses what is needed ({})", error.code().message());
  } catch (const std::exception& error) {
    return unforeseen(fmt::format(" ({})", error.what()));
  } catch (...) {
    return unforeseen("");
  }
}

[[noreturn]] void lastWords() {
  static std::once_flag only_one;
  std::call_once(only_one, [] {
    sim::abandonFiles();
    try {
      if (std::current_exception()) failDoing();
    } catch (const std::exception& error) {
      say(error.what());
    }
    ::_exit(kFailed);
  });
  ::_exit(kFailed);
}

}  // namespace

void nowDoing(const std::string& file, const std::string& stage) {
  const std::lock_guard lock(mutex);
  file_now = file;
  stage_now = stage;
}

void failDoing() {
  const std::string what = whatHappened();
  const std::lock_guard lock(mutex);
  throw Failure(fmt::format("{}: while {}: {}", file_now, stage_now, what));
}

void keepLastWords() {
  std::set_terminate(lastWords);
}

}  // namespace espalier::cli
