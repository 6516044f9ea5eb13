#include "sim/base/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <istream>
#include <mutex>
#include <set>
#include <streambuf>
#include <utility>

#include "sim/base/error.h"

namespace espalier::sim {
namespace {

constexpr std::string_view kMark = ".espalier-part-";

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags)
      : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() { close(); }

  bool ok() const { return fd_ >= 0; }
  bool write(std::string_view bytes, off_t at) {
    while (!bytes.empty()) {
      const ssize_t n = ::pwrite(fd_, bytes.data(), bytes.size(), at);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(n));
      at += n;
    }
    return true;
  }
  /// How many of so many bytes there are.
  std::size_t read(char* bytes, std::size_t count, off_t at) const {
    std::size_t got = 0;
    while (got < count) {
      const ssize_t n = ::pread(fd_, bytes + got, count - got, at + static_cast<off_t>(got));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;
      got += static_cast<std::size_t>(n);
    }
    return got;
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

/// Writes into a descriptor, reads back from it in blocks, and can be sought in from its beginning.
class FileBuffer : public std::streambuf {
 public:
  explicit FileBuffer(Descriptor& file) : file_(file) { setp(room_.data(), room_.data() + room_.size()); }

  /// Why the first failure was one (errno); 0: there was none.
  int reason() const { return reason_; }

 protected:
  int_type overflow(int_type c) override {
    if (sync() != 0) return traits_type::eof();
    return traits_type::eq_int_type(c, traits_type::eof()) ? traits_type::not_eof(c)
                                                           : sputc(traits_type::to_char_type(c));
  }
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    if (count <= epptr() - pptr()) {
      std::memcpy(pptr(), bytes, static_cast<std::size_t>(count));
      pbump(static_cast<int>(count));
      return count;
    }
    if (sync() != 0 || !put({bytes, static_cast<std::size_t>(count)})) return 0;
    begin_ += count;
    return count;
  }
  std::streamsize xsgetn(char* bytes, std::streamsize count) override {
    if (sync() != 0) return 0;
    const auto got = static_cast<std::streamsize>(file_.read(bytes, static_cast<std::size_t>(count), begin_));
    begin_ += got;
    return got;
  }
  int sync() override {
    const std::string_view waiting(pbase(), static_cast<std::size_t>(pptr() - pbase()));
    if (!put(waiting)) return -1;
    begin_ += pptr() - pbase();
    setp(room_.data(), room_.data() + room_.size());
    return 0;
  }
  pos_type seekoff(off_type off, std::ios_base::seekdir from, std::ios_base::openmode) override {
    if (from == std::ios_base::end) return pos_type(off_type(-1));
    if (from == std::ios_base::cur) off += begin_ + (pptr() - pbase());
    return seekpos(off, std::ios_base::in | std::ios_base::out);
  }
  pos_type seekpos(pos_type to, std::ios_base::openmode) override {
    if (off_type(to) == begin_ + (pptr() - pbase())) return to;  // where it is
    if (sync() != 0) return pos_type(off_type(-1));
    begin_ = to;
    return to;
  }

 private:
  bool put(std::string_view bytes) {
    if (reason_ == 0 && !file_.write(bytes, begin_)) reason_ = errno;
    return reason_ == 0;
  }

  Descriptor& file_;
  std::array<char, 65536> room_;
  off_type begin_ = 0;  // of the bytes that wait, in the file
  int reason_ = 0;
};

/// The temporary files and new folders of this process. None is made or put in its place but under the lock.
struct Parts {
  std::mutex mutex;
  std::set<std::filesystem::path> paths;
  std::uint64_t made = 0;                      // files so far
  std::vector<std::filesystem::path> folders;  // new ones, inner ones first
};

/// Those of them that hold nothing: the system removes no others. What stands in another new one goes first.
void removeEmpty(const std::vector<std::filesystem::path>& folders) {
  for (const auto& folder : folders) ::rmdir(folder.c_str());
}

Parts& parts() {
  static Parts* const all = new Parts;  // never destroyed: a thread may write until the very end
  return *all;
}

/// Under the lock. Each once: another object may have made one of the same name since.
void forget(std::vector<std::filesystem::path>& made) {
  for (const auto& folder : made) {
    const auto at = std::find(parts().folders.begin(), parts().folders.end(), folder);
    if (at != parts().folders.end()) parts().folders.erase(at);
  }
  made.clear();
}

void removePart(const std::filesystem::path& part) {
  const std::lock_guard lock(parts().mutex);
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  parts().paths.erase(part);
}

/// Whether the process that writes a temporary file still lives: its number is the end of the name. Where
/// processes are numbered anew, as in containers, a dead one may have had our own.
bool beingWritten(std::string_view name) {
  const std::string_view number = name.substr(name.rfind('-') + 1);
  pid_t writer = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), writer);
  if (error != std::errc() || end != number.data() + number.size() || writer <= 0) return false;
  if (writer != ::getpid()) return ::kill(writer, 0) == 0 || errno == EPERM;
  const std::lock_guard lock(parts().mutex);
  return std::any_of(parts().paths.begin(), parts().paths.end(),
                     [&](const std::filesystem::path& part) { return part.filename() == name; });
}

/// A new file beside `path`, of this process alone: two of its threads may be writing the same.
Descriptor newPart(const std::filesystem::path& path, std::filesystem::path& part) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const std::lock_guard lock(parts().mutex);
  for (;;) {
    part = folder / fmt::format("{}{}-{}-{}", kMark, path.filename().string(), ++parts().made, ::getpid());
    Descriptor file(part, O_RDWR | O_CREAT | O_EXCL);
    if (file.ok()) parts().paths.insert(part);
    if (file.ok() || errno != EEXIST) return file;
  }
}

}  // namespace

NewFile::NewFile(const std::filesystem::path& path, const std::function<void(std::iostream&)>& write)
    : path_(path) {
  Descriptor file = newPart(path, part_);
  const auto fail = [&](const char* what) {
    const int reason = errno;
    removePart(part_);
    throw InputError(fmt::format("{}: cannot {}: {}", path.string(), what, std::strerror(reason)));
  };
  if (!file.ok())
    throw InputError(fmt::format("{}: cannot create the file: {}", path.string(), std::strerror(errno)));
  FileBuffer buffer(file);
  std::iostream out(&buffer);
  try {
    write(out);
  } catch (const std::ios_base::failure&) {  // from writers that want to hear of it at once
    errno = buffer.reason();
    fail("write the file");
  } catch (...) {
    removePart(part_);
    throw;
  }
  if (!out.flush()) {
    errno = buffer.reason();
    fail("write the file");
  }
  if (!file.sync() || !file.close()) fail("write the file");
}

NewFile::~NewFile() {
  if (!part_.empty()) removePart(part_);
}

void NewFile::putInPlace() {
  const auto put = [&] {
    const std::lock_guard lock(parts().mutex);
    if (::rename(part_.c_str(), path_.c_str()) != 0) return false;
    parts().paths.erase(part_);
    return true;
  };
  if (!put()) {
    throw InputError(
        fmt::format("{}: cannot put the file in its place: {}", path_.string(), std::strerror(errno)));
  }
  const Descriptor directory(part_.parent_path(), O_RDONLY | O_DIRECTORY);
  if (directory.ok()) static_cast<void>(directory.sync());  // some file systems refuse to sync folders
  part_.clear();
}

// Of folders that several runs make at once each belongs to the one that made it; where a run removes one
// that another is about to make something in, that one begins again.
NewFolder::NewFolder(const std::filesystem::path& path) : path_(path) {
  std::error_code error;
  constexpr int kMostTries = 1000;  // of others that make and remove them under our hands
  for (int tries = 0; tries < kMostTries; ++tries) {
    error.clear();
    std::vector<std::filesystem::path> missing;
    for (auto folder = std::filesystem::absolute(path, error).lexically_normal();
         !folder.empty() && !std::filesystem::exists(folder, error); folder = folder.parent_path()) {
      if (folder.has_filename()) missing.push_back(folder);
    }
    error.clear();
    for (auto folder = missing.rbegin(); folder != missing.rend() && !error; ++folder) {
      if (std::filesystem::create_directory(*folder, error)) made_.insert(made_.begin(), *folder);
    }
    if (!error) std::filesystem::create_directories(path, error);
    if (!error && !std::filesystem::is_directory(path, error) && !error)
      error = std::make_error_code(std::errc::not_a_directory);
    if (error != std::errc::no_such_file_or_directory) break;
  }
  if (error) {
    removeEmpty(made_);
    throw InputError(fmt::format("{}: cannot make the folder: {}", path.string(), error.message()));
  }
  const std::lock_guard lock(parts().mutex);
  parts().folders.insert(parts().folders.begin(), made_.begin(), made_.end());
}

NewFolder::~NewFolder() {
  const std::lock_guard lock(parts().mutex);
  removeEmpty(made_);
  forget(made_);
}

void NewFolder::keep() {
  const std::lock_guard lock(parts().mutex);
  forget(made_);
}

void writeWhole(const std::filesystem::path& path, std::string_view bytes) {
  NewFile(path, [&](std::iostream& out) {
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }).putInPlace();
}

void abandonFiles() {
  parts().mutex.lock();  // and never unlocked
  std::error_code ignored;
  for (const auto& part : parts().paths) std::filesystem::remove(part, ignored);
  removeEmpty(parts().folders);
}

void removeLeftovers(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kMark) && !beingWritten(name)) std::filesystem::remove(entry.path(), ignored);
  }
}

}  // namespace espalier::sim
