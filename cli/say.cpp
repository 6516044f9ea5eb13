#include "cli/say.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include "cli/commands.h"
#include "scenes/clean_text.h"

namespace espalier::cli {
namespace {

constexpr std::string_view kClearLine = "\r\033[K";

int lost_because = 0;  ///< errno of the first result that could not be written

/// errno, or 0 where all was written.
int writeAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(n));
    } else if (errno == EAGAIN) {  // a pipe that somebody else made so that it does not wait
      pollfd room{descriptor, POLLOUT, 0};
      ::poll(&room, 1, -1);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

void result(std::string_view bytes) {
  if (lost_because == 0) lost_because = writeAll(STDOUT_FILENO, bytes);
}

void aside(const std::string& bytes) {
  writeAll(STDERR_FILENO, bytes);
}

}  // namespace

void keepStandardStreams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest that is free is taken. A folder is always there, and neither read nor written.
    if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF) static_cast<void>(::open("/", O_RDONLY));
  }
}

void print(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    shown += scenes::oneLine(text.substr(0, end));
    if (end < text.size()) shown += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  result(shown);
}

void printJson(std::string_view json) {
  result(scenes::printableJson(json));
}

void say(std::string_view line) {
  aside(scenes::oneLine(line) + "\n");
}

void sayForNow(std::string_view line) {
  aside(std::string(kClearLine) + scenes::oneLine(line));
}

void unsay() {
  aside(std::string(kClearLine));
}

int statusWithLoss(int status) {
  if (lost_because == 0) return status;
  if (lost_because != EPIPE) {
    say(fmt::format("espalier: standard output cannot be written ({}); what should stand there is lost",
                    std::strerror(lost_because)));
  }
  return status == 0 ? kFailed : status;
}

}  // namespace espalier::cli
