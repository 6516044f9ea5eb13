#include "scenes/write/video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "scenes/clean_text.h"
#include "sim/base/stop.h"

namespace espalier::scenes {
namespace {

using Clock = std::chrono::steady_clock;

// In the child.
constexpr int kFile = 3;
constexpr std::chrono::seconds kPatience(60);  // with an ffmpeg that takes nothing, or does not end
constexpr std::chrono::milliseconds kBetweenQuestions(20);  // whether to stop

void closed(int& descriptor) {
  if (descriptor >= 0) ::close(descriptor);
  descriptor = -1;
}

/// A file without a name, in memory.
int inMemory(const char* what) {
  return ::memfd_create(what, MFD_CLOEXEC);
}

std::string contentsOf(int descriptor) {
  std::string bytes;
  const off_t size = ::lseek(descriptor, 0, SEEK_END);
  if (size <= 0) return bytes;
  bytes.resize(static_cast<std::size_t>(size));
  std::size_t got = 0;
  while (got < bytes.size()) {
    const ssize_t n = ::pread(descriptor, bytes.data() + got, bytes.size() - got, static_cast<off_t>(got));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    got += static_cast<std::size_t>(n);
  }
  bytes.resize(got);
  return bytes;
}

/// One thread, and nothing of its own version, its hour or the machine's vectors in the file, so that bytes
/// repeat. Colours are those of HDTV, as players expect where a file is silent.
std::vector<std::string> commandOf(const std::string& ffmpeg, const VideoShape& shape) {
  return {ffmpeg,
          "-nostdin",
          "-hide_banner",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pixel_format",
          "rgb24",
          "-video_size",
          fmt::format("{}x{}", shape.width_px, shape.height_px),
          "-framerate",
          fmt::format("{}", shape.frames_per_second),
          "-threads",
          "1",
          "-i",
          "pipe:0",
          "-filter_threads",
          "1",
          "-vf",
          "scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+accurate_rnd+full_chroma_int+bitexact,"
          "format=yuv420p",
          "-c:v",
          "libx264",
          "-preset",
          "medium",
          "-crf",
          "17",
          "-threads",
          "1",
          "-colorspace",
          "bt709",
          "-color_primaries",
          "bt709",
          "-color_trc",
          "bt709",
          "-color_range",
          "tv",
          "-map_metadata",
          "-1",
          "-fflags",
          "+bitexact",
          "-flags:v",
          "+bitexact",
          "-movflags",
          "+faststart",
          "-f",
          "mp4",
          fmt::format("/proc/self/fd/{}", kFile)};
}

/// Calls nothing that another thread of the parent may have held locked. Signals stay as the parent blocks
/// them, but for those that it has handlers for.
[[noreturn]] void becomeFfmpeg(char* const* command, pid_t parent, int frames, int file, int messages) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(126);  // the parent went before the line above could tie us to it
  ::setpgid(0, 0);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  // Out of the way of the numbers that they get: dup2 would close one of them.
  const auto aside = [](int fd) { return ::fcntl(fd, F_DUPFD, 16); };
  const int in = aside(frames), out = aside(file), err = aside(messages), null = aside(nowhere);
  if (::dup2(in, STDIN_FILENO) < 0 || ::dup2(null, STDOUT_FILENO) < 0 || ::dup2(err, STDERR_FILENO) < 0 ||
      ::dup2(out, kFile) < 0)
    ::_exit(126);
  for (const int fd : {in, out, err, null}) ::close(fd);
  ::execv(command[0], command);
  ::_exit(127);
}

std::string lastLineOf(const std::string& text) {
  const std::size_t end = text.find_last_not_of("\r\n");
  if (end == text.npos) return "";
  const std::size_t line = text.find_last_of("\r\n", end);
  return text.substr(line == text.npos ? 0 : line + 1, end - (line == text.npos ? 0 : line + 1) + 1);
}

}  // namespace

std::filesystem::path ffmpegProgram() {
  const char* const path = std::getenv("PATH");
  std::string folders = path != nullptr ? path : "";
  for (std::size_t begin = 0; begin <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', begin), folders.size());
    const std::filesystem::path program =
        std::filesystem::path(folders.substr(begin, end - begin)) / "ffmpeg";
    std::error_code none;
    if (end > begin && std::filesystem::is_regular_file(program, none) &&
        ::access(program.c_str(), X_OK) == 0)
      return std::filesystem::absolute(program);
    begin = end + 1;
  }
  return {};
}

Video::Video(const std::filesystem::path& ffmpeg, const VideoShape& shape) {
  std::array<int, 2> ends{-1, -1};
  file_ = inMemory("film");
  messages_ = inMemory("messages");
  if (file_ < 0 || messages_ < 0 || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    const std::string why = std::strerror(errno);
    end();
    throw std::runtime_error(fmt::format("cannot reach ffmpeg: {}", why));
  }
  frames_ = ends[0];
  std::vector<std::string> words = commandOf(ffmpeg.string(), shape);
  std::vector<char*> command;
  for (std::string& word : words) command.push_back(word.data());
  command.push_back(nullptr);
  const pid_t parent = ::getpid();
  child_ = ::fork();
  if (child_ == 0) becomeFfmpeg(command.data(), parent, ends[1], file_, messages_);
  closed(ends[1]);
  if (child_ < 0) {
    const std::string why = std::strerror(errno);
    end();
    throw std::runtime_error(fmt::format("cannot start a process: {}", why));
  }
}

Video::~Video() {
  end();
}

void Video::end() {
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    ended(true);
  }
  closed(frames_);
  closed(file_);
  closed(messages_);
}

/// Whether the child has ended, which is then known once and for all.
bool Video::ended(bool wait) {
  if (child_ < 0) return true;
  pid_t gone = 0;
  do {
    gone = ::waitpid(child_, &status_, wait ? 0 : WNOHANG);
  } while (gone < 0 && errno == EINTR);
  if (gone == 0) return false;
  child_ = -1;
  return true;
}

void Video::add(std::span<const std::uint8_t> rgb) {
  auto deadline = Clock::now() + kPatience;
  while (!rgb.empty() && failure_.empty() && frames_ >= 0) {
    sim::throwIfStopped();
    pollfd wait{frames_, POLLOUT, 0};
    if (::poll(&wait, 1, static_cast<int>(kBetweenQuestions.count())) <= 0) {
      if (Clock::now() > deadline) failure_ = "ffmpeg took nothing for a minute";
      continue;
    }
    const ssize_t n = ::send(frames_, rgb.data(), rgb.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (n <= 0) {
      closed(frames_);  // it has ended: finish() asks why
      return;
    }
    rgb = rgb.subspan(static_cast<std::size_t>(n));
    deadline = Clock::now() + kPatience;
  }
}

Video::Made Video::finish() {
  closed(frames_);
  const auto deadline = Clock::now() + kPatience;
  while (failure_.empty() && !ended(false)) {
    sim::throwIfStopped();
    ::poll(nullptr, 0, 2);
    if (Clock::now() > deadline) failure_ = "ffmpeg did not end";
  }
  Made made;
  if (failure_.empty() && WIFEXITED(status_) && WEXITSTATUS(status_) == 0) {
    made.bytes = contentsOf(file_);
    if (!made.bytes.empty()) return made;
    failure_ = "ffmpeg wrote nothing";
  }
  if (failure_.empty()) {
    const std::string says = oneLine(lastLineOf(contentsOf(messages_)));
    failure_ = WIFSIGNALED(status_) ? fmt::format("ffmpeg was ended by signal {}", WTERMSIG(status_))
                                    : fmt::format("ffmpeg ended with status {}", WEXITSTATUS(status_));
    if (!says.empty()) failure_ += ": " + says;
  }
  made.failure = failure_;
  return made;
}

}  // namespace espalier::scenes
