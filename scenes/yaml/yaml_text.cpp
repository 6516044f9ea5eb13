#include "scenes/yaml/yaml_text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "scenes/clean_text.h"
#include "sim/base/hasher.h"

namespace espalier::scenes {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

/// YAML indents by spaces only; yaml-cpp's word for a tab there is "illegal map value".
bool checkIndents(const std::string& text, const std::shared_ptr<const std::string>& path,
                  Problems& problems) {
  bool good = true;
  int line = 1;
  for (std::size_t start = 0; start < text.size(); ++line) {
    const auto tab = std::min(text.find_first_not_of(' ', start), text.size());
    const auto word = std::min(text.find_first_not_of(" \t", tab), text.size());
    const bool says_something =
        word < text.size() && text[word] != '#' && text[word] != '\n' && text[word] != '\r';
    if (tab < word && says_something) {
      problems.add({path, line, static_cast<int>(tab - start) + 1},
                   "a tab before the first word; expected spaces");
      good = false;
    }
    const auto end = text.find('\n', word);
    start = end == text.npos ? text.size() : end + 1;
  }
  return good;
}

}  // namespace

std::optional<std::string> readText(const std::string& path, const Place& asker, Problems& problems,
                                    std::uint64_t* hash) {
  const auto refuse = [&](std::string_view why) {
    problems.add(asker, *asker.path == path ? std::string(why) : fmt::format("{}: {}", path, why));
    return std::nullopt;
  };
  // Opened without waiting, then asked what it is: a pipe must not hang us, nor may the file change in
  // between.
  const Descriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (file.get() < 0)
    return refuse(fmt::format("cannot be opened ({}); expected a readable file", std::strerror(errno)));
  struct stat status {};
  if (fstat(file.get(), &status) != 0)
    return refuse(fmt::format("cannot be examined ({})", std::strerror(errno)));
  if (!S_ISREG(status.st_mode)) return refuse("is no regular file; expected a text file");
  std::string text;
  char buffer[65536];
  while (true) {
    const auto got = read(file.get(), buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return refuse(fmt::format("cannot be read ({})", std::strerror(errno)));
    if (got == 0) break;
    text.append(buffer, static_cast<std::size_t>(got));
    if (text.size() > kMaxTextBytes)
      return refuse(fmt::format("is too large; expected at most {} bytes", kMaxTextBytes));
  }
  if (hash != nullptr) *hash = sim::hashOf(text);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  return text;
}

bool checkText(const std::string& text, const std::shared_ptr<const std::string>& path, Problems& problems) {
  bool good = true;
  int line = 1, column = 1, last_bad_line = 0;
  for (std::size_t i = 0; i < text.size();) {
    const auto [code, bytes] = characterAt(std::string_view(text).substr(i));
    const bool is_space =
        code == '\t' || code == '\n' || (code == '\r' && i + 1 < text.size() && text[i + 1] == '\n');
    if ((bytes == 0 || (isControl(code) && !is_space)) && line != last_bad_line) {
      problems.add(
          {path, line, column},
          bytes == 0 ? fmt::format("byte 0x{:02x} is no UTF-8; expected text in UTF-8",
                                   static_cast<unsigned char>(text[i]))
                     : fmt::format("the control character U+{:04X}; expected text without control characters",
                                   code));
      last_bad_line = line;
      good = false;
    }
    if (code == '\n') {
      ++line;
      column = 1;
    } else {
      ++column;
    }
    i += bytes == 0 ? 1 : bytes;
  }
  return checkIndents(text, path, problems) && good;
}

}  // namespace espalier::scenes
