#include "sim/base/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <mutex>
#include <set>

#include "sim/base/error.h"

namespace espalier::sim {
namespace {

constexpr std::string_view kMark = ".espalier-part-";

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags)
      : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  bool ok() const { return fd_ >= 0; }
  bool write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::write(fd_, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
  }
  bool sync() const { return ::fsync(fd_) == 0; }
  bool close() {
    const int fd = fd_;
    fd_ = -1;
    return fd < 0 || ::close(fd) == 0;
  }

 private:
  int fd_;
};

/// The temporary files of this process. None is made or put in its place but under the lock.
struct Parts {
  std::mutex mutex;
  std::set<std::filesystem::path> paths;
};

Parts& parts() {
  static Parts* const all = new Parts;  // never destroyed: a thread may write until the very end
  return *all;
}

/// Whether the process that writes a temporary file still lives: its number is the end of the name.
bool beingWritten(std::string_view name) {
  const std::string_view number = name.substr(name.rfind('-') + 1);
  pid_t writer = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), writer);
  if (error != std::errc() || end != number.data() + number.size() || writer <= 0) return false;
  return ::kill(writer, 0) == 0 || errno == EPERM;
}

}  // namespace

void writeWhole(const std::filesystem::path& path, std::string_view bytes) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const auto part = folder / fmt::format("{}{}-{}", kMark, path.filename().string(), ::getpid());
  const auto create = [&] {
    const std::lock_guard lock(parts().mutex);
    parts().paths.insert(part);
    return Descriptor(part, O_WRONLY | O_CREAT | O_TRUNC);
  };
  const auto fail = [&](const char* what) {
    const int reason = errno;
    const std::lock_guard lock(parts().mutex);
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    parts().paths.erase(part);
    throw InputError(fmt::format("{}: cannot {}: {}", path.string(), what, std::strerror(reason)));
  };
  const auto put = [&] {
    const std::lock_guard lock(parts().mutex);
    if (::rename(part.c_str(), path.c_str()) != 0) return false;
    parts().paths.erase(part);
    return true;
  };
  Descriptor file = create();
  if (!file.ok()) fail("create the file");
  if (!file.write(bytes) || !file.sync() || !file.close()) fail("write the file");
  if (!put()) fail("put the file in its place");
  const Descriptor directory(folder, O_RDONLY | O_DIRECTORY);
  if (directory.ok()) static_cast<void>(directory.sync());  // some file systems refuse to sync folders
}

void abandonFiles() {
  parts().mutex.lock();  // and never unlocked
  std::error_code ignored;
  for (const auto& part : parts().paths) std::filesystem::remove(part, ignored);
}

void removeLeftovers(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kMark) && !beingWritten(name)) std::filesystem::remove(entry.path(), ignored);
  }
}

}  // namespace espalier::sim
